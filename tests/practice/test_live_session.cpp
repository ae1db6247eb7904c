#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <calligraphy/base/error.hpp>
#include <calligraphy/devices/device_profiles.hpp>
#include <calligraphy/devices/simulated_device.hpp>
#include <calligraphy/practice/live_session.hpp>
#include <calligraphy/practice/score.hpp>
#include <calligraphy/practice/session.hpp>
#include <calligraphy/practice/writer.hpp>

#include "../catch.hpp"
#include "pages.hpp"

using namespace calligraphy;
using namespace calligraphy_test;

namespace {

constexpr double period = 1e-3;  // [s]

Capabilities at_rate(Capabilities profile, double rate) {
  profile.update_rate = rate;
  return profile;
}

/// A device with its own scheduler, like that of a vendor, held by a simulated writer. It runs in virtual time but in
/// step with the watching thread, so that no tick is lost on a slow machine.
class HeldDevice final : public HapticDevice, public ServoClock {
 public:
  explicit HeldDevice(const PracticePage& page, const WriterSkill& skill = WriterSkill::skilled(), double rate = 1000.0)
      : HeldDevice(page, upright_page(page.width, page.height), skill, rate) {}
  HeldDevice(const PracticePage& page, const MotionMapping& mapping, const WriterSkill& skill = WriterSkill::skilled(),
             double rate = 1000.0)
      : period_(1.0 / rate),
        mapping_(mapping),
        device_(at_rate(device_profile("desktop"), rate), skill.grip,
                mapping_.to_device({0.5 * page.width, 0.5 * page.height, 0.02})),
        eyes_(page.characters, mapping_, device_.capabilities(), RendererOptions::for_device(device_.capabilities())),
        writer_(page, skill, 1) {}
  ~HeldDevice() override { HeldDevice::stop(); }

  const Capabilities& capabilities() const noexcept override { return device_.capabilities(); }
  DeviceState read() noexcept override {
    ++reads;
    DeviceState state = device_.read();
    if (unplugged_after > 0.0 && device_.time() > unplugged_after && device_.time() < unplugged_after + 0.3) {
      state.status = DeviceStatus::disconnected;
      state.fault = DeviceFault::unplugged;
    }
    if (device_.time() < behind_until) state.position = mapping_.to_device({0.08, 0.02, -0.05});
    return state;
  }
  void write(const Eigen::Vector3d& force) noexcept override {
    last_force = force;
    max_force = std::max(max_force, force.norm());
    device_.write(force);
  }
  void close() noexcept override { device_.close(); }
  ServoClock* clock() noexcept override { return this; }
  std::vector<std::string> warnings() const override { return {"no priority"}; }
  std::string advice() const override { return ticks_ < 300 ? "put the pen into the inkwell" : ""; }

  void start(std::function<void(double)> tick) override {
    stopping_ = false;
    thread_ = std::thread([this, tick = std::move(tick)] {
      while (!stopping_) {
        tick(device_.time());
        move();
        if (++ticks_ % 200 == 0) wait();
      }
    });
  }
  void stop() noexcept override {
    stopping_ = true;
    if (thread_.joinable()) thread_.join();
  }
  bool running() const noexcept override { return thread_.joinable(); }

  /// Called by the watching thread: permits the next ticks.
  void seen() { ++glances_; }
  std::uint64_t ticks() const { return ticks_; }

  double unplugged_after = 0.0;  ///< for 0.3 s; 0: never [s]
  double behind_until = 0.0;     ///< the pen is behind the paper [s]
  double max_force = 0.0;        ///< [N]
  std::atomic<int> reads = 0;
  Eigen::Vector3d last_force = Eigen::Vector3d::Zero();

 private:
  void move() {
    const HapticTick& tick = eyes_.update(device_.read());
    const VisualFeedback sight = visual_feedback(tick);
    const Intention next = writer_.update(sight, period_);
    device_.set_intention(
        {mapping_.to_device(next.position), mapping_.rotation.transpose() * next.velocity / mapping_.scale});
    device_.advance(period_);
  }
  void wait() const {
    const int before = glances_;
    while (!stopping_ && glances_ == before) std::this_thread::yield();
  }

  double period_;  ///< [s]
  MotionMapping mapping_;
  SimulatedDevice device_;
  HapticRenderer eyes_;
  SimulatedWriter writer_;
  std::thread thread_;
  std::atomic<bool> stopping_ = false;
  std::atomic<int> glances_ = 0;
  std::atomic<std::uint64_t> ticks_ = 0;
};

LiveOptions watched(HeldDevice& device, std::vector<LiveView>* views = nullptr) {
  LiveOptions options;
  options.renderer = RendererOptions::for_device(device.capabilities());
  options.servo.servo.timeout = 1.0;  // the watchdog uses the wall clock, which virtual time does not follow
  options.watch = [&device, views](const LiveView& view) {
    if (views) views->push_back(view);
    device.seen();
    return true;
  };
  return options;
}

}  // namespace

TEST_CASE("a page is written on a desk, at twice the motion of the hand") {
  const PracticePage page = page_of("十");
  const MotionMapping mapping = desk_page(page.width, page.height, 2.0);
  HeldDevice device(page, mapping);
  LiveOptions options = watched(device);
  options.mapping = mapping;
  options.watch = [&device](const LiveView&) {
    device.seen();
    return device.ticks() < 60'000;  // should it never be finished
  };
  const LiveResult result = write_with_device(page, device, options);
  const CharacterScore written = score_page(page, result.recording).front();
  CHECK(written.strokes_completed == 2);
  CHECK(written.rms_error < 0.001);
}

TEST_CASE("a page is written on a device with its own clock, and every tick is recorded") {
  const PracticePage page = page_of("十");
  HeldDevice device(page);
  std::vector<LiveView> views;
  const LiveResult result = write_with_device(page, device, watched(device, &views));
  CHECK(result.dropped == 0);
  CHECK(result.recording.samples.size() <= result.statistics.ticks);  // none during the final ramp-down of the force
  const CharacterScore written = score_page(page, result.recording).front();
  CHECK(written.strokes_completed == 2);
  CHECK(written.match.remarks.empty());
  const LessonScore judged = score_lesson(result.writing).front();
  CHECK(judged.right_at_once == 2);
  CHECK(judged.score.rms_error == Approx(written.rms_error).epsilon(0.02));
  CHECK(device.max_force > 0.1);
  REQUIRE(!views.empty());
  CHECK(views.back().progress == 1.0);
  for (std::size_t i = 1; i < views.size(); ++i) CHECK(views[i].progress >= views[i - 1].progress);
  const std::vector<RecordedSample>& samples = result.recording.samples;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    REQUIRE(samples[i].time - samples[i - 1].time == Approx(period).margin(1e-9));
  }
}

TEST_CASE("after a session the force is zero and the device still open") {
  const PracticePage page = page_of("十");
  HeldDevice device(page);
  LiveOptions options = watched(device);
  int glances = 0;
  options.watch = [&](const LiveView&) {
    device.seen();
    return ++glances < 8;  // in the middle of a stroke
  };
  const LiveResult result = write_with_device(page, device, options);
  CHECK(score_page(page, result.recording).front().strokes_completed < 2);
  CHECK(!device.running());
  CHECK(device.last_force.isZero(0.0));
  CHECK(result.statistics.ticks + result.statistics.idle_ticks == device.ticks());  // nothing has moved since
  CHECK(device.read().status == DeviceStatus::ok);
}

TEST_CASE("a law that throws ends a live session, whose recording is kept") {
  const PracticePage page = page_of("十");
  HeldDevice device(page);
  LiveOptions options = watched(device);
  options.renderer.guidance.force = [](const GuidanceInput& in) -> Point {
    if (in.arc > 0.002) throw std::runtime_error("out of ideas");
    return Point::Zero();
  };
  const LiveResult result = write_with_device(page, device, options);
  CHECK_THROWS_WITH(std::rethrow_exception(result.error), "out of ideas");
  CHECK(device.last_force.isZero(0.0));
  CHECK(result.recording.samples.size() > 100);
}

TEST_CASE("ticks since the last call of watch are recorded too") {
  const PracticePage page = page_of("十");
  HeldDevice device(page);
  LiveOptions options = watched(device);
  options.watch = [&](const LiveView&) {  // the first call after the start sees at most 200 ticks
    if (!device.running()) return true;
    device.seen();
    while (device.ticks() < 400) std::this_thread::yield();
    return false;
  };
  CHECK(write_with_device(page, device, options).recording.samples.size() > 200);
}

TEST_CASE("ticks missing from the recording are counted") {
  const PracticePage page = page_of("十");
  HeldDevice device(page);
  LiveOptions options = watched(device);
  constexpr std::uint64_t away = 20000;  // twice the capacity of the queue
  options.watch = [&](const LiveView&) {
    if (!device.running()) return true;
    while (device.ticks() < away) device.seen();
    return false;
  };
  const LiveResult result = write_with_device(page, device, options);
  CHECK(result.dropped > 0);
  CHECK(result.recording.samples.size() + result.dropped > away / 2);
}

TEST_CASE("no force exceeds the requested peak") {
  const PracticePage page = page_of("十");
  HeldDevice device(page);
  LiveOptions options = watched(device);
  options.peak_force = 0.3;
  const LiveResult result = write_with_device(page, device, options);
  CHECK(score_page(page, result.recording).front().strokes_completed == 2);
  CHECK(device.max_force > 0.1);
  CHECK(device.max_force <= 0.3 + 1e-12);
}

TEST_CASE("a pen that comes out of an inkwell behind the paper writes nothing on its way") {
  const PracticePage page = page_of("十");
  HeldDevice device(page);
  device.behind_until = 0.2;
  std::vector<LiveView> views;
  const LiveResult result = write_with_device(page, device, watched(device, &views));
  REQUIRE(views.size() > 2);
  CHECK_FALSE(views.front().started);
  CHECK(views.back().started);
  CHECK(views[1].behind == Approx(0.05));
  CHECK(views.back().behind == 0.0);
  CHECK(std::is_partitioned(views.begin(), views.end(), [](const LiveView& view) { return !view.started; }));
  const CharacterScore written = score_page(page, result.recording).front();
  CHECK(written.strokes_completed == 2);
  CHECK(written.match.remarks.empty());
  REQUIRE(!result.recording.samples.empty());
  CHECK(result.recording.samples.front().device_point.z() > 0.0);
}

TEST_CASE("a person is told hints and refusals, and a stroke that is not written is shown and skipped") {
  const PracticePage page = page_of("一");
  HeldDevice device(page_of("二"));  // the hand writes above and below the stroke that is due
  std::vector<LessonEvent> events;
  LiveOptions options = watched(device);
  bool is_shown = false;
  options.watch = [&](const LiveView& view) {
    for (const LessonEvent& event : view.events) {
      events.push_back(event);
      is_shown = is_shown || event.kind == LessonEventKind::shown;
      if (event.kind != LessonEventKind::hinted) continue;
      CHECK(event.hint == WritingHint::too_far);
      CHECK(view.lesson.hint == event.hint);
    }
    device.seen();
    return device.ticks() < 20'000;  // should it never end
  };
  options.commands = [&] {
    return is_shown ? std::vector{LessonCommandKind::skip} : std::vector<LessonCommandKind>();
  };
  const LiveResult result = write_with_device(page, device, options);
  std::string told;
  for (const LessonEvent& event : events) told += std::string(to_string(event.kind)) + " ";
  CHECK(told == "restarted hinted refused hinted refused shown skipped finished ");
  CHECK(device.ticks() < 20'000);
  CHECK(result.writing.attempts.size() == 2);
  CHECK(result.writing.strokes.front().fate == StrokeFate::skipped);
  CHECK(result.writing.recording.samples.empty());
  CHECK_FALSE(result.recording.setup);  // what came in does not tell of the skip
  CHECK(result.recording.inputs.size() == result.recording.samples.size());
}

TEST_CASE("with vision alone no force is sent") {
  const PracticePage page = page_of("一");
  HeldDevice device(page);
  LiveOptions options = watched(device);
  options.mode = FeedbackMode::vision;
  const LiveResult result = write_with_device(page, device, options);
  CHECK(score_page(page, result.recording).front().strokes_completed == 1);
  CHECK(device.max_force == 0.0);
  for (const RecordedSample& sample : result.recording.samples) REQUIRE(sample.force.isZero(0.0));
}

TEST_CASE("a device unplugged for a moment is reported, and the page is completed") {
  const PracticePage page = page_of("十");
  HeldDevice device(page);
  device.unplugged_after = 1.5;
  std::vector<LiveView> views;
  const LiveResult result = write_with_device(page, device, watched(device, &views));
  CHECK(result.statistics.fault_count(DeviceFault::unplugged) == 1);
  CHECK(std::any_of(views.begin(), views.end(),
                    [](const LiveView& view) { return view.servo.fault == DeviceFault::unplugged; }));
  CHECK(score_page(page, result.recording).front().strokes_completed == 2);
}

TEST_CASE("a session runs at the rate of the device, however low, and refuses another") {
  constexpr double rate = 400.0;
  const PracticePage page = page_of("十");
  HeldDevice device(page, WriterSkill::skilled(), rate);
  LiveOptions options = watched(device);
  int glances = 0;
  options.watch = [&](const LiveView&) {
    device.seen();
    return ++glances < 3;
  };
  SECTION("the loop and the recording") {
    const LiveResult result = write_with_device(page, device, options);
    CHECK(result.recording.rate == rate);
    CHECK(result.statistics.ticks > 0);
    CHECK(result.statistics.missed_deadlines == 0);
  }
  SECTION("neither the servo nor the renderer may have one of its own") {
    options.servo.servo.rate = 1000.0;
    CHECK_THROWS_WITH(write_with_device(page, device, options),
                      "servo loop: rate = 1000 Hz, but the force law is made for 400 Hz");
    options.renderer.servo_rate = 1000.0;
    CHECK_THROWS_WITH(write_with_device(page, device, options),
                      "servo loop: rate = 1000 Hz, but the device has a clock of its own, at 400 Hz");
  }
  SECTION("with a timeout of enough ticks") {
    options.servo = {};  // 4 ms
    CHECK_NOTHROW(write_with_device(page, device, options));
  }
}

TEST_CASE("a session reports what the system did not permit, and measures its ticks") {
  const PracticePage page = page_of("一");
  HeldDevice device(page);
  LiveOptions options = watched(device);
  options.servo.thread.priority = 0;
  options.servo.thread.lock_memory = false;
  std::vector<std::string> told;
  options.watch = [&](const LiveView& view) {
    if (device.reads == 0) told = view.warnings;  // so before any force
    device.seen();
    return true;
  };
  const LiveResult result = write_with_device(page, device, options);
  CHECK(result.warnings == device.warnings());
  CHECK(told == device.warnings());
  CHECK(std::any_of(result.recording.samples.begin(), result.recording.samples.end(),
                    [](const RecordedSample& sample) { return sample.tick_ns > 0; }));
}

TEST_CASE("a display shows what the person has to do with the device, for as long as it is so") {
  const PracticePage page = page_of("一");
  HeldDevice device(page);
  std::vector<LiveView> views;
  write_with_device(page, device, watched(device, &views));
  CHECK(views.front().advice == "put the pen into the inkwell");
  CHECK(views.back().advice.empty());
}

TEST_CASE("a session ends at its timeout") {
  const PracticePage page = page_of("十");
  HeldDevice device(page);
  LiveOptions options = watched(device);
  options.timeout = 0.05;  // at most three calls of 200 ticks each; a stroke takes longer
  CHECK(score_page(page, write_with_device(page, device, options).recording).front().strokes_completed < 2);
}

TEST_CASE("forces are limited to a peak and never raised") {
  Capabilities device;
  device.peak_force = 3.3;
  device.continuous_force = 0.88;
  struct Case {
    double peak, lowered_peak, lowered_continuous;
  };
  for (const Case c : {Case{0.5, 0.5, 0.5}, Case{2.0, 2.0, 0.88}, Case{5.0, 3.3, 0.88},
                       Case{std::numeric_limits<double>::infinity(), 3.3, 0.88}}) {
    CAPTURE(c.peak);
    CHECK(with_peak_force(device, c.peak).peak_force == c.lowered_peak);
    CHECK(with_peak_force(device, c.peak).continuous_force == c.lowered_continuous);
  }
  for (const double peak : {0.0, -1.0, std::nan("")}) CHECK_THROWS_AS(with_peak_force(device, peak), ValueError);
}

TEST_CASE("a session without a finite timeout is rejected") {
  const PracticePage page = page_of("十");
  HeldDevice device(page);
  LiveOptions options = watched(device);
  for (const double timeout : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    options.timeout = timeout;
    CHECK_THROWS_AS(write_with_device(page, device, options), ValueError);
  }
  CHECK(!device.running());
}

TEST_CASE("a live session is made again from what came in, to the last bit") {
  const PracticePage page = page_of("十");
  HeldDevice device(page, WriterSkill::novice());
  LiveOptions options = watched(device);
  std::size_t kept = 0, calls = 0;
  options.keep = [&](const Recording& recording) {
    CHECK(recording.setup);
    CHECK((calls++ > 0 || recording.samples.empty()));
    kept = recording.samples.size();
  };
  const Recording first = write_with_device(page, device, options).recording;
  CHECK(kept == first.samples.size());
  const Recording again = replayed(first);
  REQUIRE(again.samples.size() == first.samples.size());
  for (std::size_t i = 0; i < first.samples.size(); ++i) {
    CAPTURE(i);
    REQUIRE(again.samples[i].stroke == first.samples[i].stroke);
    REQUIRE(again.samples[i].force == first.samples[i].force);
  }
}
