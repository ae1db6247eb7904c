#include <calligraphy/devices/openhaptics/openhaptics_device.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <utility>

#include <calligraphy/base/error.hpp>
#include <calligraphy/devices/device_profiles.hpp>

#include "base/monotonic_clock.hpp"
#include "errors.hpp"
#include "heat_limit.hpp"
#include "scheduler_clock.hpp"

namespace calligraphy {
namespace {

using namespace hdapi;

constexpr double millimetre = 1e-3;  // [m]
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr int max_errors = 16;       // fetched per tick

/// Interval between checks of calibration and temperature: short for a person, long enough to cost nothing [ticks].
constexpr int check_interval = 50;

std::string text(const char* string) { return string != nullptr ? string : ""; }

bool holds(const std::string& name, const char* part) { return name.find(part) != std::string::npos; }

/// The closest built-in profile, or the weakest one if none matches, for values that the runtime does not provide.
const Capabilities& closest_profile(const std::string& model) {
  if (holds(model, "Premium")) return device_profile("premium-1.5");
  if (holds(model, "Desktop") || holds(model, "Touch X")) return device_profile("desktop");
  if (holds(model, "Omni")) return device_profile("omni");
  return device_profile("touch");
}

Enum style_of(CalibrationStyle style) noexcept {
  switch (style) {
    case CalibrationStyle::encoder_reset:
      return calibration_encoder_reset;
    case CalibrationStyle::automatic:
      return calibration_automatic;
    case CalibrationStyle::inkwell:
      return calibration_inkwell;
  }
  return calibration_inkwell;
}

bool within(double value, double smallest, double largest) noexcept {
  return std::isfinite(value) && value >= smallest && value <= largest;
}

/// Limits the magnitude. Scales by the largest component first, so that no square overflows.
Eigen::Vector3d shortened(const Eigen::Vector3d& force, double limit) noexcept {
  const double largest = force.cwiseAbs().maxCoeff();
  if (largest == 0.0) return force;
  const Eigen::Vector3d scaled = force / largest;
  const double length = scaled.norm();
  return largest * length <= limit ? force : Eigen::Vector3d(scaled * (limit / length));
}

}  // namespace

class OpenHapticsDevice::Implementation {
 public:
  explicit Implementation(const OpenHapticsOptions& options);
  ~Implementation() { close(); }

  DeviceState read() noexcept;
  void write(const Eigen::Vector3d& force) noexcept;
  void close() noexcept;
  std::string advice() const;

  std::shared_ptr<Runtime> runtime;
  Capabilities capabilities;
  std::string serial;
  std::atomic<ErrorCode> last_error = no_error;
  std::unique_ptr<SchedulerClock> clock;

 private:
  const Functions& hd() const noexcept { return runtime->functions(); }
  Handle open_device(const OpenHapticsOptions& options);
  Capabilities ask_capabilities();
  void check_calibration() noexcept;
  void check_temperature() noexcept;
  Diagnosis take_errors() noexcept;

  double (*time_)() noexcept;
  Enum calibration_style_;
  Handle device_ = invalid_handle;
  std::atomic<bool> open_ = false;
  double opened_ = 0.0;  ///< [s]
  Eigen::Vector3d centre_ = Eigen::Vector3d::Zero();  ///< of the workspace, in the runtime's coordinates [m]
  DeviceState state_;
  Eigen::Vector3d sent_ = Eigen::Vector3d::Zero();  ///< as passed to the runtime [N]
  HeatLimit heat_;
  bool asks_temperature_ = true;  ///< false once the runtime has refused to report it
  double temperature_ = unknown;  ///< of the warmest motor at the last check; 1: the vendor's limit
  int until_check_ = 0;           ///< [ticks]
  std::atomic<Enum> calibration_ = calibration_ok;  ///< at the last check
  std::atomic<bool> is_warm_ = false;
};

OpenHapticsDevice::Implementation::Implementation(const OpenHapticsOptions& options)
    : runtime(Runtime::load(options.library)),
      time_(options.time != nullptr ? options.time : monotonic_seconds),
      calibration_style_(style_of(options.calibration)) {
  if (runtime->scheduler_runs()) {
    throw DeviceError("a servo loop runs on another device of " + runtime->library() +
                      ": open all devices before the first loop starts");
  }
  device_ = open_device(options);
  open_ = true;
  capabilities = ask_capabilities();
  calibration_ = hd().hdCheckCalibration();
  runtime->take_errors();  // discards those from queries that a model does not support
  clock = std::make_unique<SchedulerClock>(runtime, device_, time_);
  opened_ = time_();
  state_.velocity.setZero();
  state_.velocity_estimated = true;  // by the runtime
  state_.status = DeviceStatus::stale;
}

Handle OpenHapticsDevice::Implementation::open_device(const OpenHapticsOptions& options) {
  runtime->take_errors();
  const Handle device = hd().hdInitDevice(options.device.empty() ? nullptr : options.device.c_str());
  const std::string errors = runtime->take_errors();
  // Errors such as warm motors may be reported although the device did open.
  if (device != invalid_handle) {
    hd().hdMakeCurrentDevice(device);
    return device;
  }
  const std::string name = options.device.empty() ? "its default device" : "the device \"" + options.device + "\"";
  throw DeviceError(runtime->library() + " does not open " + name + (errors.empty() ? "" : " (" + errors + ")") +
                    ": plug it in and switch it on, add it with the vendor's setup program, and close other programs "
                    "that use it");
}

Capabilities OpenHapticsDevice::Implementation::ask_capabilities() {
  const std::string model = text(hd().hdGetString(device_model));
  serial = text(hd().hdGetString(device_serial));
  Capabilities result = closest_profile(model);
  result.simulated = false;
  if (!model.empty()) result.model = model;

  // Larger than needed, in case a model returns more values.
  double box[16] = {};
  hd().hdGetDoublev(usable_workspace, box);
  const Eigen::Map<const Eigen::Vector3d> low(box), high(box + 3);
  const Eigen::Vector3d extent = millimetre * (high - low);
  if (std::all_of(extent.begin(), extent.end(), [](double length) { return within(length, 0.01, 3.0); })) {
    result.workspace = extent;
    centre_ = 0.5 * millimetre * (low + high);
  }

  double number[16] = {};
  hd().hdGetDoublev(max_force, number);
  if (within(number[0], 0.1, 100.0)) result.peak_force = number[0];
  number[0] = 0.0;
  hd().hdGetDoublev(continuous_force, number);
  if (within(number[0], 0.01, result.peak_force)) result.continuous_force = number[0];
  int rate[16] = {};
  hd().hdGetIntegerv(update_rate, rate);
  if (within(rate[0], 100.0, 10'000.0)) result.update_rate = rate[0];
  return result;
}

DeviceState OpenHapticsDevice::Implementation::read() noexcept {
  if (!open_ || !clock->within_tick()) {
    DeviceState last = state_;
    last.status = open_ ? DeviceStatus::stale : DeviceStatus::disconnected;
    return last;
  }
  double position[3] = {};
  double velocity[3] = {};
  double transform[16];
  std::fill_n(transform, 16, unknown);  // of a runtime that does not fill it in
  int buttons = 0;
  hd().hdGetDoublev(current_position, position);
  hd().hdGetDoublev(current_velocity, velocity);
  hd().hdGetDoublev(current_transform, transform);
  hd().hdGetIntegerv(current_buttons, &buttons);
  const bool is_due = --until_check_ <= 0;
  if (is_due) check_calibration();
  Diagnosis diagnosis = take_errors();
  if (is_due) {
    until_check_ = check_interval;
    check_temperature();
  }
  const double time = whole_nanoseconds(time_() - opened_);
  heat_.update(diagnosis.status == DeviceStatus::warm_motors, temperature_, time - state_.time);
  is_warm_.store(heat_.is_warm(), std::memory_order_relaxed);
  if (heat_.is_warm()) diagnosis = more_severe(diagnosis, {DeviceStatus::warm_motors, DeviceFault::none});
  if (calibration_.load(std::memory_order_relaxed) != calibration_ok) {
    diagnosis = more_severe(diagnosis, {DeviceStatus::needs_calibration, DeviceFault::uncalibrated});
  }
  state_.time = time;
  state_.position = millimetre * Eigen::Vector3d(position[0], position[1], position[2]) - centre_;
  state_.velocity = millimetre * Eigen::Vector3d(velocity[0], velocity[1], velocity[2]);
  state_.force = clock->output_on() ? sent_ : Eigen::Vector3d(Eigen::Vector3d::Zero());
  state_.buttons = static_cast<std::uint32_t>(buttons) & 0xF;
  const double* const barrel = transform + 8;  // the axis z of the stylus, from its tip to its other end
  state_.stylus.altitude = std::atan2(barrel[2], std::hypot(barrel[0], barrel[1]));
  state_.stylus.azimuth = std::atan2(barrel[1], barrel[0]);
  state_.status = diagnosis.status;
  state_.fault = diagnosis.fault;
  return state_;
}

void OpenHapticsDevice::Implementation::check_calibration() noexcept {
  Enum calibration = hd().hdCheckCalibration();
  if (calibration == calibration_needs_update) {
    hd().hdUpdateCalibration(calibration_style_);
    calibration = hd().hdCheckCalibration();
  }
  calibration_.store(calibration, std::memory_order_relaxed);
}

/// Call when no errors are pending: any that follow are then about this query alone.
void OpenHapticsDevice::Implementation::check_temperature() noexcept {
  if (!asks_temperature_) return;
  constexpr double most_plausible = 2.0;  // a higher value is on another scale
  double motors[16];
  std::fill(std::begin(motors), std::end(motors), unknown);
  hd().hdGetDoublev(motor_temperature, motors);
  temperature_ = unknown;
  for (const double motor : motors) temperature_ = std::fmax(temperature_, motor);
  if (!within(temperature_, 0.0, most_plausible)) temperature_ = unknown;
  for (int i = 0; i < max_errors; ++i) {
    const ErrorCode code = hd().hdGetError().code;
    if (code == no_error) break;
    temperature_ = unknown;
    if (concerns_call(code)) asks_temperature_ = false;
  }
}

Diagnosis OpenHapticsDevice::Implementation::take_errors() noexcept {
  Diagnosis result;
  for (int i = 0; i < max_errors; ++i) {
    const ErrorInfo error = hd().hdGetError();
    if (error.code == no_error) break;
    last_error.store(error.code, std::memory_order_relaxed);
    result = more_severe(result, diagnose(error.code));
  }
  return result;
}

void OpenHapticsDevice::Implementation::write(const Eigen::Vector3d& force) noexcept {
  if (!open_) return;
  if (!clock->within_tick()) {
    if (force.isZero(0.0)) clock->cut_force();
    return;
  }
  const double limit = heat_.share() * capabilities.peak_force;
  sent_ = force.allFinite() ? shortened(force, limit) : Eigen::Vector3d(Eigen::Vector3d::Zero());
  clock->set_force({sent_.x(), sent_.y(), sent_.z()});
}

void OpenHapticsDevice::Implementation::close() noexcept {
  if (!open_) return;
  if (clock != nullptr) clock->stop();
  hd().hdDisableDevice(device_);
  open_ = false;
}

std::string OpenHapticsDevice::Implementation::advice() const {
  if (calibration_.load(std::memory_order_relaxed) == calibration_ok) {
    return is_warm_.load(std::memory_order_relaxed) ? advice_text(DeviceStatus::warm_motors) : "";
  }
  if (calibration_style_ == calibration_inkwell) return "needs calibration: put the pen into the inkwell";
  if (calibration_style_ == calibration_encoder_reset) {
    return "needs calibration: hold the pen in the pose that the vendor's manual prescribes for an encoder reset";
  }
  return "needs calibration: move the pen slowly through the entire workspace";
}

OpenHapticsDevice::OpenHapticsDevice(const OpenHapticsOptions& options)
    : implementation_(std::make_unique<Implementation>(options)) {}

OpenHapticsDevice::~OpenHapticsDevice() = default;

const Capabilities& OpenHapticsDevice::capabilities() const noexcept { return implementation_->capabilities; }
DeviceState OpenHapticsDevice::read() noexcept { return implementation_->read(); }
void OpenHapticsDevice::write(const Eigen::Vector3d& force) noexcept { implementation_->write(force); }
void OpenHapticsDevice::close() noexcept { implementation_->close(); }
std::vector<std::string> OpenHapticsDevice::warnings() const {
  return {
      "the vendor documents no watchdog: whether the device switches its motors off when this program is killed "
      "(SIGKILL) or the computer fails is not known. Keep a hand at the device's switch"};
}
ServoClock* OpenHapticsDevice::clock() noexcept { return implementation_->clock.get(); }
const std::string& OpenHapticsDevice::serial() const noexcept { return implementation_->serial; }
const std::string& OpenHapticsDevice::library() const noexcept { return implementation_->runtime->library(); }
std::uint32_t OpenHapticsDevice::last_error() const noexcept {
  return implementation_->last_error.load(std::memory_order_relaxed);
}
std::string OpenHapticsDevice::advice() const { return implementation_->advice(); }

OpenHapticsRuntime openhaptics_runtime(const std::string& library) {
  OpenHapticsRuntime result;
  try {
    result.library = hdapi::Runtime::load(library)->library();
    result.found = true;
  } catch (const DeviceError& error) {
    result.advice = error.what();
  }
  return result;
}

}  // namespace calligraphy
