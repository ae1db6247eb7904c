// How long a link waits before it says that nothing comes, and how urgent its threads are.
#pragma once

namespace calligraphy::phantom {

/// In the clock of the machine: far above the few milliseconds after which a servo loop calls a device silent, so that
/// a link speaks of it only when the bus is at fault.
struct LinkOptions {
  double silence = 1.0;  ///< without a transfer from the device before `timed_out`, and before that is told again [s]
  double answer = 0.25;  ///< until the device has taken a packet, before `timed_out` [s]
  double search = 0.1;   ///< between two looks for a device that is gone, where the system does not tell of it [s]
  int priority = 0;      ///< real-time priority of its threads, 1 to 99; 0: ordinary ones
};

}  // namespace calligraphy::phantom
