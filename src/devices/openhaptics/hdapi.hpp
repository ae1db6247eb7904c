// The types, constants and functions of the vendor's HDAPI used here, declared from its public interface.
#pragma once

#include <cstdint>

namespace calligraphy::hdapi {

using Handle = unsigned int;
using Enum = unsigned int;
using ErrorCode = unsigned int;
using Boolean = unsigned char;
using CallbackCode = unsigned int;
using SchedulerHandle = unsigned long;
using Callback = CallbackCode (*)(void*);

struct ErrorInfo {
  ErrorCode code;
  int internal_code;
  Handle device;
};

inline constexpr Handle invalid_handle = 0xFFFFFFFF;
inline constexpr CallbackCode callback_done = 0;
inline constexpr CallbackCode callback_continue = 1;

inline constexpr Enum current_buttons = 0x2000;
inline constexpr Enum current_position = 0x2050;  // [mm]
inline constexpr Enum current_velocity = 0x2051;  // [mm/s]
inline constexpr Enum current_transform = 0x2052;  // of the stylus, 4 x 4, column by column [mm]
inline constexpr Enum device_model = 0x2501;
inline constexpr Enum device_serial = 0x2504;
inline constexpr Enum usable_workspace = 0x2551;
inline constexpr Enum update_rate = 0x2600;
inline constexpr Enum max_force = 0x2603;         // [N]
inline constexpr Enum continuous_force = 0x2604;  // [N]
inline constexpr Enum motor_temperature = 0x2605;  // per motor, 0 cold to 1 too hot
inline constexpr Enum current_force = 0x2700;     // [N]
inline constexpr Enum force_output = 0x4000;

inline constexpr Enum calibration_ok = 0x5000;
inline constexpr Enum calibration_needs_update = 0x5001;
inline constexpr Enum calibration_needs_manual_input = 0x5002;
inline constexpr Enum calibration_encoder_reset = 1;
inline constexpr Enum calibration_automatic = 2;
inline constexpr Enum calibration_inkwell = 4;

// The high byte is the group: 1 functions, 2 forces, 3 device, 4 frames, 5 scheduler, 6 licence.
inline constexpr ErrorCode no_error = 0;
inline constexpr ErrorCode invalid_operation = 0x0102;
inline constexpr ErrorCode warm_motors = 0x0200;
inline constexpr ErrorCode exceeded_max_force = 0x0201;
inline constexpr ErrorCode exceeded_impulse = 0x0202;
inline constexpr ErrorCode exceeded_velocity = 0x0203;
inline constexpr ErrorCode force_error = 0x0204;
inline constexpr ErrorCode device_fault = 0x0300;
inline constexpr ErrorCode comm_error = 0x0302;
inline constexpr ErrorCode comm_config_error = 0x0303;
inline constexpr ErrorCode timer_error = 0x0304;
inline constexpr ErrorCode frame_error = 0x0402;

/// Function pointers, named as in the library.
struct Functions {
  Handle (*hdInitDevice)(const char* name);
  void (*hdMakeCurrentDevice)(Handle);
  void (*hdDisableDevice)(Handle);
  void (*hdBeginFrame)(Handle);
  void (*hdEndFrame)(Handle);
  ErrorInfo (*hdGetError)();
  const char* (*hdGetErrorString)(ErrorCode);
  void (*hdEnable)(Enum);
  void (*hdDisable)(Enum);
  void (*hdGetDoublev)(Enum, double*);
  void (*hdSetDoublev)(Enum, const double*);
  void (*hdGetIntegerv)(Enum, int*);
  const char* (*hdGetString)(Enum);
  Enum (*hdCheckCalibration)();
  void (*hdUpdateCalibration)(Enum style);
  void (*hdStartScheduler)();
  void (*hdStopScheduler)();
  SchedulerHandle (*hdScheduleAsynchronous)(Callback, void*, unsigned short priority);
  void (*hdUnschedule)(SchedulerHandle);
};

}  // namespace calligraphy::hdapi
