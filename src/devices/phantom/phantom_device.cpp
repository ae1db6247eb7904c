#include <calligraphy/devices/phantom/phantom_device.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>
#include <utility>

#include <calligraphy/base/error.hpp>
#include <calligraphy/devices/detail/force_guard.hpp>
#include <calligraphy/devices/device_profiles.hpp>
#include <calligraphy/devices/emergency_stop.hpp>
#include <calligraphy/devices/latest_value.hpp>
#include <calligraphy/devices/servo.hpp>

#include "base/monotonic_clock.hpp"
#include "base/require.hpp"
#include "devices/phantom/link/link.hpp"
#include "devices/phantom/wire/packet_codec.hpp"
#include "devices/phantom/wire/report_frames.hpp"
#include "force_output.hpp"
#include "motion_tracker.hpp"
#include "motor_temperature.hpp"

namespace calligraphy {
namespace {

using namespace phantom;

// Far below what encoders resolve. Digits beyond would only take space in recordings.
constexpr double steps_per_metre = 1e9;     // of a position [1/m]
constexpr double steps_per_velocity = 1e6;  // [s/m]
constexpr double fault_time = 20e-3;      // time for which a fault is reported: longer than any ramp-down [s]
constexpr double silence = 8e-3;          // time without a report: three times the longest pause of a real device [s]
constexpr double write_patience = 20e-3;  // time without a command [s]
constexpr double ramp_down = 10e-3;       // [s]
constexpr double ramp_up = 0.1;           // [s]

WireProfile profile_of(const PhantomOptions& options) {
  if (options.wire_profile.empty()) {
    throw ValueError(
        "no wire profile is given. The packets of a Touch are not public: describe them in a file as explained in "
        "docs/wire-profile.md (\"calligraphy devices probe\" captures them), and pass that file "
        "(PhantomOptions::wire_profile)");
  }
  const std::vector<std::string> shipped = wire_profile_names();
  const bool is_shipped = std::ranges::find(shipped, options.wire_profile) != shipped.end();
  const WireProfile profile = is_shipped ? wire_profile(options.wire_profile) : read_wire_profile(options.wire_profile);
  const std::vector<std::string> missing = options.drive ? missing_for_force(profile) : missing_for_position(profile);
  if (missing.empty()) return profile;
  std::string lines;
  for (const std::string& line : missing) lines += (lines.empty() ? "" : ", ") + line;
  throw ValueError("wire profile \"" + profile.name + "\" gives no " + (options.drive ? "force" : "position") +
                   ": it lacks " + lines + ". Calibrate your device and add these lines to a copy of the profile");
}

const PhantomOptions& checked(const PhantomOptions& options) {
  require_within("velocity_cutoff", options.velocity_cutoff, "Hz", 1.0, 1000.0);
  require(options.priority >= 0 && options.priority <= 99, "priority", options.priority, "",
          "from 1 to 99, or 0 for normal threads");
  return options;
}

std::function<double()> clock_or_monotonic(std::function<double()> clock) {
  return clock ? std::move(clock) : std::function<double()>(monotonic_seconds);
}

Eigen::Vector3d rounded(const Eigen::Vector3d& vector, double steps) noexcept {
  return ((vector * steps).array().round() + 0.0) / steps;
}

}  // namespace

void validate(const PhantomOptions& options) {
  checked(options);
  profile_of(options);
  linkage(options.model);
}

/// State of the link's thread and of the servo loop, and what they share.
class PhantomDevice::Core final : public LinkListener {
 public:
  Core(std::unique_ptr<Link> link, const PhantomOptions& options, std::function<double()> clock)
      : options_(checked(options)),
        clock_(clock_or_monotonic(std::move(clock))),
        codec_(profile_of(options)),
        linkage_(linkage(options.model)),
        capabilities_(device_profile(options.model)),
        frames_(codec_),
        tracker_(codec_.profile(), linkage_, options.velocity_cutoff),
        guard_(ramp_down, ramp_up),
        output_(codec_, linkage_, capabilities_, options),
        bus_(link.get()),
        link_(std::move(link)) {
    capabilities_.update_rate = codec_.profile().rate;
    capabilities_.simulated = false;
    capabilities_.velocity_cutoff = options_.velocity_cutoff;
    opened_at_ = clock_();
    last_report_ = opened_at_;
    silent_until_ = opened_at_;
    last_write_.store(opened_at_, std::memory_order_relaxed);
    if (codec_.profile().command_size > 0) stop_packet_size_ = frames_.wrap(RawCommand{}, stop_packet_).size();
    description_ = link_->description();
    link_->open(*this);
    description_ = link_->description();
    warnings_ = link_->warnings();
    if (options_.drive) warn_of_profile();
  }

  // Called by the link's thread.

  void received(std::span<const std::byte> bytes) noexcept override {
    const double now = clock_();
    take_calibration();
    frames_.feed(bytes, [&](const RawSample& sample) { process(sample, now); });
    counts_.skipped_bytes.store(frames_.skipped_bytes(), std::memory_order_relaxed);
    switch_off_if_idle(now);
  }

  void changed(DeviceFault fault) noexcept override {
    const DeviceFault before = link_fault_.load(std::memory_order_relaxed);
    if (fault != DeviceFault::none) {
      report_fault(fault, clock_());
      start_due_ = start_due_ || fault != DeviceFault::overlong_frame;  // an overlong frame leaves the link up
    } else if (!started_ || before == DeviceFault::unplugged) {
      frames_.reset();
      tracker_.restart(started_ && options_.keep_calibration);
      started_ = true;
    }
    // A device that resets without leaving the bus may be silent until it receives its start commands.
    if (start_due_ && !closing_.load(std::memory_order_acquire) &&
        (fault == DeviceFault::none || fault == DeviceFault::timed_out)) {
      const bool taken = send_all(codec_.profile().start);
      if (fault == DeviceFault::none) {
        start_due_ = !taken;
        if (!taken) {
          fault = DeviceFault::link_error;
          report_fault(fault, clock_());
        }
      }
    }
    link_fault_.store(fault, std::memory_order_release);
  }

  std::span<const std::byte> stop_packet() const noexcept override {
    return std::span(stop_packet_).first(stop_packet_size_);
  }

  // Called by the servo loop.

  DeviceState read() noexcept {
    const bool fresh = latest_.take(motion_);
    const double now = clock_();
    if (fresh) last_report_ = motion_.time;
    DeviceState state;
    state.time = whole_nanoseconds(last_report_ - opened_at_);
    state.position = rounded(motion_.position, steps_per_metre);
    state.velocity = rounded(motion_.velocity, steps_per_velocity);
    state.velocity_estimated = true;
    state.force = motors_on_.load(std::memory_order_relaxed) ? sent_force_ : Eigen::Vector3d::Zero();
    state.buttons = motion_.buttons;
    state.fault = fault_now(now);
    const std::uint64_t fault_count = fault_count_.load(std::memory_order_acquire);
    if (state.fault == DeviceFault::none && fault_count != faults_seen_)
      state.fault = momentary_fault_.load(std::memory_order_relaxed);
    faults_seen_ = fault_count;
    if (!open_ || state.fault == DeviceFault::unplugged) {
      state.status = DeviceStatus::disconnected;
    } else if (state.fault != DeviceFault::none) {
      state.status = DeviceStatus::fault;
    } else if (!motion_.calibrated) {
      state.status = DeviceStatus::needs_calibration;
      state.fault = DeviceFault::uncalibrated;
    } else if (!fresh) {
      state.status = DeviceStatus::stale;
    } else if (output_.warmest() >= MotorTemperature::warm) {
      state.status = DeviceStatus::warm_motors;
    }
    if (state.status != DeviceStatus::stale) status_.store(state.status, std::memory_order_relaxed);
    return state;
  }

  void write(const Eigen::Vector3d& force) noexcept {
    if (!open_) return;
    const double now = clock_();
    double elapsed = std::max(now - last_write_.load(std::memory_order_relaxed), 0.0);
    last_write_.store(now, std::memory_order_release);
    output_.pass_time(elapsed);
    if (elapsed > write_patience) {  // the motors have been switched off in the meantime
      guard_.reset();
      elapsed = 0.0;
    }
    DeviceFault fault = fault_now(now);
    if (fault == DeviceFault::none && !motion_.calibrated) fault = DeviceFault::uncalibrated;
    const bool good = options_.drive && fault == DeviceFault::none && !motion_.docked;
    const Eigen::Vector3d wanted = output_.shortened(force);
    Eigen::Vector3d allowed;
    if (good) {
      allowed = guard_.pass(wanted, elapsed);
      good_joints_ = motion_.joints;
    } else {
      allowed = guard_.fall(fault, elapsed, 2.0 / capabilities_.update_rate);
      // A servo loop may ramp down faster.
      if (wanted.norm() < allowed.norm()) allowed *= wanted.norm() / allowed.norm();
    }
    const double gain = guard_.phase() == ServoPhase::zero ? 0.0 : guard_.gain();
    if (send(output_.command(good_joints_, allowed, gain), Sender::servo_loop)) sent_force_ = output_.force();
  }

  void switch_off() noexcept {
    if (!open_) return;
    open_ = false;
    closing_.store(true, std::memory_order_release);  // no start commands from here on
    send_final_packet();
    send_all(codec_.profile().stop);
  }

  /// After switch_off().
  void close_link() noexcept {
    if (!link_) return;
    closed_counts_ = link_->counts();
    link_.reset();
  }

  /// Async-signal-safe, until close_link().
  void cut_force() noexcept { bus_->cut_force(); }

  // Called during set-up or by any thread.

  void calibrate(const Joints& joints) noexcept {
    for (std::size_t i = 0; i < 3; ++i) {
      asked_joints_[i].store(joints[static_cast<Eigen::Index>(i)], std::memory_order_relaxed);
    }
    calibration_asked_.store(true, std::memory_order_release);
  }

  PhantomStatistics statistics() const noexcept;
  const Capabilities& capabilities() const noexcept { return capabilities_; }
  const Motion& motion() const noexcept { return motion_; }
  const std::string& description() const noexcept { return description_; }
  const std::vector<std::string>& warnings() const noexcept { return warnings_; }
  /// Status of the last sample that was not stale.
  DeviceStatus status() const noexcept { return status_.load(std::memory_order_relaxed); }

 private:
  struct Counts {
    std::atomic<std::uint64_t> reports = 0, used = 0, lost = 0, repeated = 0, skipped_bytes = 0;
    std::atomic<std::uint64_t> commands = 0, refused = 0, released = 0;
    std::array<std::atomic<std::uint64_t>, device_fault_count> faults{};
  };

  /// Warns of missing fields without which nothing protects the user once this program has been killed.
  void warn_of_profile() {
    const WireProfile& profile = codec_.profile();
    const std::string start = "wire profile \"" + profile.name + "\" has no line \"";
    if (!profile.toggle) {
      warnings_.push_back(start +
                          "toggle\": whether the device switches its motors off when this program is killed (SIGKILL) "
                          "or the computer fails is not known. Keep a hand at the device's switch");
    }
    if (!profile.motors_on) {
      warnings_.push_back(start + "motors-on\": the motors get a torque of zero, but cannot be switched off");
    }
  }

  static void count(std::atomic<std::uint64_t>& counter, std::uint64_t more = 1) noexcept {
    counter.fetch_add(more, std::memory_order_relaxed);
  }

  void process(const RawSample& sample, double now) noexcept {
    count(counts_.reports);
    const MotionTracker::Result result = tracker_.take(sample, now);
    count(counts_.lost, result.lost);
    if (result.repeated) count(counts_.repeated);
    if (result.fault != DeviceFault::none) report_fault(result.fault, now);
    if (!result.fresh) return;
    count(counts_.used);
    latest_.publish(tracker_.motion());
  }

  /// Reports a momentary fault to both threads.
  void report_fault(DeviceFault fault, double now) noexcept {
    count(counts_.faults[static_cast<std::size_t>(fault)]);
    momentary_fault_.store(fault, std::memory_order_relaxed);
    fault_until_.store(now + fault_time, std::memory_order_relaxed);
    fault_count_.fetch_add(1, std::memory_order_release);
  }

  /// The fault that currently prevents a force; for the thread of the servo loop.
  DeviceFault fault_now(double now) noexcept {
    const DeviceFault link_fault = link_fault_.load(std::memory_order_acquire);
    if (link_fault != DeviceFault::none) return link_fault;
    if (fault_count_.load(std::memory_order_acquire) > 0 && now < fault_until_.load(std::memory_order_relaxed)) {
      return momentary_fault_.load(std::memory_order_relaxed);
    }
    if (output_.overheated()) return DeviceFault::overheated;
    if (now - last_report_ > silence) {
      if (now >= silent_until_) count(counts_.faults[static_cast<std::size_t>(DeviceFault::silent)]);
      silent_until_ = now + fault_time;
    }
    return now < silent_until_ ? DeviceFault::silent : DeviceFault::none;
  }

  void take_calibration() noexcept {
    if (!calibration_asked_.load(std::memory_order_acquire)) return;
    calibration_asked_.store(false, std::memory_order_relaxed);
    Joints joints;
    for (std::size_t i = 0; i < 3; ++i) {
      joints[static_cast<Eigen::Index>(i)] = asked_joints_[i].load(std::memory_order_relaxed);
    }
    tracker_.calibrate(joints);
  }

  /// Switches the motors off when the servo loop no longer calls write(); they would otherwise hold the last command.
  void switch_off_if_idle(double now) noexcept {
    if (!motors_on_.load(std::memory_order_relaxed)) return;
    if (now - last_write_.load(std::memory_order_acquire) <= write_patience) return;
    if (send({}, Sender::link_thread)) count(counts_.released);
  }

  enum class Sender : std::uint8_t { servo_loop, link_thread };

  /// Called by both threads; gives up if the other one is sending. Only commands of the servo loop change the dead-man
  /// bit, and the other thread sends nothing once the servo loop has written again.
  bool send(RawCommand command, Sender sender) noexcept {
    if (codec_.profile().command_size == 0 || sending_.test_and_set(std::memory_order_acquire)) return false;
    bool sent = false;
    const bool of_servo = sender == Sender::servo_loop;
    if (of_servo || clock_() - last_write_.load(std::memory_order_acquire) > write_patience) {
      if (emergency_stopped()) command = {};
      if (of_servo) toggle_ = !toggle_;
      command.toggle = toggle_;
      sent = bus_->send(frames_.wrap(command, packet_));
      count(sent ? counts_.commands : counts_.refused);
      if (sent) motors_on_.store(command.motors_on, std::memory_order_relaxed);
    }
    sending_.clear(std::memory_order_release);
    return sent;
  }

  /// Sends the final packet: it replaces a pending one, then is sent as a command, which nothing can overtake.
  void send_final_packet() noexcept {
    if (codec_.profile().command_size == 0) return;
    while (sending_.test_and_set(std::memory_order_acquire)) std::this_thread::yield();  // never cleared
    RawCommand off;
    off.toggle = toggle_;
    const std::span<const std::byte> packet = frames_.wrap(off, packet_);
    bus_->send(packet);
    try {
      bus_->command(packet);
    } catch (...) {  // the device is gone
    }
  }

  bool send_all(const std::vector<std::vector<std::byte>>& commands) noexcept {
    try {
      std::array<std::byte, max_framed_bytes> packet;
      for (const std::vector<std::byte>& bytes : commands) bus_->command(frames_.wrap(bytes, packet));
      return true;
    } catch (...) {
      return false;
    }
  }

  PhantomOptions options_;
  std::function<double()> clock_;
  PacketCodec codec_;
  const Linkage& linkage_;
  Capabilities capabilities_;
  double opened_at_ = 0.0;
  std::string description_;
  std::vector<std::string> warnings_;

  // Used only by the link's thread.
  ReportFrames frames_;
  MotionTracker tracker_;
  bool started_ = false;
  bool start_due_ = true;

  // From the link's thread to the servo loop.
  LatestValue<Motion> latest_;
  std::atomic<DeviceFault> link_fault_ = DeviceFault::none;  ///< persistent
  std::atomic<DeviceFault> momentary_fault_ = DeviceFault::none;
  std::atomic<double> fault_until_ = 0.0;
  std::atomic<std::uint64_t> fault_count_ = 0;  ///< number of momentary faults

  // From the servo loop to the link's thread.
  std::atomic<double> last_write_ = 0.0;
  std::atomic<bool> motors_on_ = false;
  std::array<std::atomic<double>, 3> asked_joints_{};
  std::atomic<bool> calibration_asked_ = false;

  // Used only by the thread that holds `sending_`.
  std::atomic_flag sending_;
  bool toggle_ = false;
  std::array<std::byte, max_framed_bytes> packet_{};

  // Constant once the device is open.
  std::array<std::byte, max_framed_bytes> stop_packet_{};
  std::size_t stop_packet_size_ = 0;

  // Used only by the servo loop.
  bool open_ = true;
  Motion motion_;
  double last_report_ = 0.0;
  double silent_until_ = 0.0;
  std::uint64_t faults_seen_ = 0;
  Joints good_joints_ = Joints::Zero();  ///< at the last good force; during a fault the newest may be wrong
  detail::ForceGuard guard_;
  ForceOutput output_;
  Eigen::Vector3d sent_force_ = Eigen::Vector3d::Zero();  ///< force of the last command sent [N]

  std::atomic<DeviceStatus> status_ = DeviceStatus::stale;  ///< for any thread
  Counts counts_;
  LinkCounts closed_counts_;
  std::atomic<bool> closing_ = false;
  Link* const bus_;             ///< the link, also for its own thread, which runs while link_ is being destroyed
  std::unique_ptr<Link> link_;  ///< last, so that it is destroyed before anything that its thread uses
};

PhantomStatistics PhantomDevice::Core::statistics() const noexcept {
  const auto value = [](const std::atomic<std::uint64_t>& counter) { return counter.load(std::memory_order_relaxed); };
  PhantomStatistics result;
  result.reports = value(counts_.reports);
  result.used_reports = value(counts_.used);
  result.lost_reports = value(counts_.lost);
  result.repeated_reports = value(counts_.repeated);
  result.skipped_bytes = value(counts_.skipped_bytes);
  result.commands = value(counts_.commands);
  result.refused_commands = value(counts_.refused);
  result.released = value(counts_.released);
  for (std::size_t i = 0; i < device_fault_count; ++i) result.faults[i] = value(counts_.faults[i]);
  const LinkCounts link = link_ ? link_->counts() : closed_counts_;
  result.transfers_failed = link.failed;
  result.commands_replaced = link.replaced;
  result.opened = link.opened;
  result.warmest_motor = output_.published_warmest();
  return result;
}

PhantomDevice::PhantomDevice(std::unique_ptr<Link> link, const PhantomOptions& options, std::function<double()> clock) {
  if (!link) throw ValueError("PhantomDevice: the link is null");
  core_ = std::make_unique<Core>(std::move(link), options, std::move(clock));
  if (options.drive) entry_.emplace(*this);
}

PhantomDevice::~PhantomDevice() { close(); }

const Capabilities& PhantomDevice::capabilities() const noexcept { return core_->capabilities(); }
DeviceState PhantomDevice::read() noexcept { return core_->read(); }
void PhantomDevice::write(const Eigen::Vector3d& force) noexcept { core_->write(force); }
void PhantomDevice::cut_force() noexcept { core_->cut_force(); }

void PhantomDevice::close() noexcept {
  core_->switch_off();
  entry_.reset();
  core_->close_link();
}

void PhantomDevice::calibrate(const Joints& joints) {
  for (const double joint : joints) require(std::isfinite(joint), "joint", joint, "rad", "finite");
  core_->calibrate(joints);
}

const Joints& PhantomDevice::joints() const noexcept { return core_->motion().joints; }
bool PhantomDevice::docked() const noexcept { return core_->motion().docked; }
PhantomStatistics PhantomDevice::statistics() const noexcept { return core_->statistics(); }
const std::string& PhantomDevice::description() const noexcept { return core_->description(); }
std::vector<std::string> PhantomDevice::warnings() const { return core_->warnings(); }
std::string PhantomDevice::advice() const { return advice_text(core_->status()); }

}  // namespace calligraphy
