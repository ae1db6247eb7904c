// Time-outs of a link and the priority of its threads.
#pragma once

namespace calligraphy::phantom {

/// Times by the wall clock, far above the few milliseconds after which a servo loop reports a device as silent, so that
/// a link reports a time-out only if the bus is at fault.
struct LinkOptions {
  double silence = 1.0;  ///< time without a transfer from the device until `timed_out` is reported, or repeated [s]
  double answer = 0.25;  ///< time for the device to accept a packet, until `timed_out` [s]
  double search = 0.1;   ///< interval of searches for a missing device if the system reports no hot-plug events [s]
  double settle = 0.3;   ///< time for which the node of a HID must answer before it is opened again [s]
  int priority = 0;      ///< real-time priority of its threads, 1 to 99; 0: normal threads
};

}  // namespace calligraphy::phantom
