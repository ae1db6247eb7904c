#include <calligraphy/practice/lesson.hpp>

#include <array>
#include <atomic>
#include <cstddef>
#include <utility>

#include <calligraphy/base/error.hpp>
#include <calligraphy/devices/latest_value.hpp>
#include <calligraphy/devices/sample_queue.hpp>

#include "lesson_desk.hpp"
#include "lesson_machine.hpp"

namespace calligraphy {
namespace {

constexpr std::size_t max_commands = 64, max_events = 1024;
constexpr std::uint64_t ticks_of_a_look = 16;  // after which the state is published again, if nothing else has changed

}  // namespace

struct Lesson::Loop {
  Loop(LessonScene& scene, std::size_t capacity, bool records_every_tick)
      : commands(max_commands),
        events(max_events),
        samples(capacity),
        ticks(records_every_tick ? capacity : 1),
        machine(scene, events),
        scenes(max_commands),
        records_all(records_every_tick) {}

  void obey(const DeviceState& sample) noexcept;
  bool is_off_paper(const DeviceState& sample) const noexcept;
  void take(LessonCommandKind command) noexcept;
  void record(const HapticTick& tick, const DeviceState& input, const LessonHand* hand) noexcept;

  std::atomic<bool> is_called = false;  ///< since the loop looked, something was put into the first two queues
  SampleQueue<LessonCommand> commands;
  SampleQueue<LessonEvent> events;
  SampleQueue<LessonSample> samples;
  SampleQueue<RecordedTick> ticks;  ///< the same, if all are recorded
  LatestValue<LessonState> states;
  LessonMachine machine;
  SampleQueue<LessonScene*> scenes;
  LessonScene* wanted = nullptr;  ///< that is entered next; null: none
  DeviceState silent;  ///< the last sample of a pen that is not to be seen
  bool records_all;
  bool can_be_made_again = true;  ///< the ticks of the page so far, by a renderer that knows nothing of the lesson
  std::array<LessonCommand, max_commands> waiting;  ///< for their ticks, in the order in which they were sent
  std::size_t waiting_count = 0;
  bool has_work = false;  ///< for obey()
};

/// Carries out the commands that are due, and goes over to another scene.
[[gnu::noinline]] void Lesson::Loop::obey(const DeviceState& sample) noexcept {
  const std::uint64_t tick = machine.state().tick;
  while ((!wanted || wanted->tick <= tick) && scenes.pop(wanted)) {  // of several that are due, the last is entered
  }
  if (wanted && wanted->tick <= tick && is_off_paper(sample) && machine.can_enter(*wanted)) [[unlikely]] {
    const bool begins = wanted->start != machine.scene().start;
    can_be_made_again = begins && !wanted->wanted.guidance.assist.enabled;  // what it has faded to is kept
    machine.enter(*wanted);
    wanted = nullptr;
  }
  if (machine.is_resume_asked() && is_off_paper(sample)) [[unlikely]] machine.resume();
  while (waiting_count < waiting.size() && commands.pop(waiting[waiting_count])) ++waiting_count;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < waiting_count; ++i) {
    if (waiting[i].tick <= tick) {
      take(waiting[i].kind);
    } else {
      waiting[kept++] = waiting[i];
    }
  }
  waiting_count = kept;
  has_work = waiting_count > 0 || wanted || !scenes.is_empty() || machine.is_resume_asked();
}

/// Whether no force acts on the pen, and none would at once if a renderer saw it for the first time.
bool Lesson::Loop::is_off_paper(const DeviceState& sample) const noexcept {
  const HapticRenderer& renderer = machine.scene().renderer;
  if (!machine.sees_pen()) return renderer.mapping().to_page(sample.position).z() > 0.0;
  return !machine.state().is_on_paper && renderer.last().force == Eigen::Vector3d(Eigen::Vector3d::Zero());
}

/// Carries out a command: one that tells the renderer which stroke is due, or will when the pen is lifted, is not in
/// what came in.
void Lesson::Loop::take(LessonCommandKind command) noexcept {
  using Kind = LessonCommandKind;
  const bool is_of_pen_down = command == Kind::pause || command == Kind::ignore;
  const bool is_of_stroke = command == Kind::skip || command == Kind::undo;
  if (is_of_stroke || (is_of_pen_down && machine.state().pen_down >= 0)) can_be_made_again = false;
  machine.take(command);
}

void Lesson::Loop::record(const HapticTick& tick, const DeviceState& input, const LessonHand* hand) noexcept {
  LessonSample sample;
  sample.time = tick.time;
  sample.pen_tip = tick.pen_tip.head<2>();
  if (hand) sample.hand = *hand;
  sample.hand.pressure = input.stylus.pressure;
  sample.height = static_cast<float>(tick.pen_tip.z());
  sample.device_point = tick.device_point.cast<float>();
  sample.force = tick.page_force.cast<float>();
  sample.pen_down = machine.ink();
  sample.start = machine.scene().start;
  sample.character = tick.character;
  sample.stroke = tick.stroke;
  sample.events = tick.events;
  sample.state = tick.state;
  sample.status = tick.status;
  sample.can_be_made_again = can_be_made_again;
  const bool is_pushed = samples.push(sample);
  const SessionTick& session = machine.scene().session;
  if (records_all && is_pushed) ticks.push({session.sample(), session.input(input)});
}

Lesson::Lesson(std::vector<PracticePage> pages, const Capabilities& device, const LessonOptions& options)
    : desk_(std::make_unique<LessonDesk>(std::move(pages), device, options)),
      loop_(std::make_unique<Loop>(desk_->newest(), desk_->capacity(), options.records_all)) {}

Lesson::~Lesson() = default;

const HapticTick& Lesson::update(const DeviceState& sample, const LessonHand* hand) noexcept {
  Loop& loop = *loop_;
  LessonMachine& machine = loop.machine;
  if (loop.is_called.load(std::memory_order_relaxed)) [[unlikely]] {
    loop.is_called.exchange(false, std::memory_order_acquire);
    loop.has_work = true;
  }
  if (loop.has_work) [[unlikely]] loop.obey(sample);
  LessonScene& scene = machine.scene();
  const DeviceState* seen = &sample;
  if (!machine.sees_pen()) [[unlikely]] {
    loop.silent = sample;
    loop.silent.status = DeviceStatus::stale;
    seen = &loop.silent;
  }
  const HapticTick& tick = scene.is_plain ? scene.renderer.update(*seen) : scene.session.update(*seen);
  if (hand) machine.set_hand(hand->place);
  machine.update(tick);
  const bool has_set_assistance = machine.state().assistance != tick.assistance;
  if (tick.events != TickEvent::none && has_set_assistance) [[unlikely]] loop.can_be_made_again = false;
  if (machine.ink() >= 0 || tick.events != TickEvent::none || loop.records_all) loop.record(tick, *seen, hand);
  if (machine.take_change() || machine.state().tick % ticks_of_a_look == 0) loop.states.publish(machine.state());
  return tick;
}

const Eigen::Vector3d& Lesson::force() const noexcept {
  const LessonScene& scene = loop_->machine.scene();
  return scene.is_plain ? scene.renderer.last().force : scene.session.force();
}
void Lesson::ignore() noexcept { loop_->take(LessonCommandKind::ignore); }
bool Lesson::sees_pen() const noexcept { return loop_->machine.sees_pen(); }
bool Lesson::is_waiting() const noexcept { return loop_->machine.is_waiting(); }
bool Lesson::has_commands() const noexcept {
  return loop_->has_work || loop_->is_called.load(std::memory_order_relaxed);
}
std::exception_ptr Lesson::law_error() const {
  const LessonScene& scene = loop_->machine.scene();
  if (!loop_->machine.state().has_failed) return nullptr;
  return scene.is_plain ? guidance_error(scene.renderer) : scene.session.error();
}

bool Lesson::send(const LessonCommand& command) noexcept {
  const bool is_taken = loop_->commands.push(command);
  loop_->is_called.store(true, std::memory_order_release);
  return is_taken;
}

void Lesson::post(LessonScene& scene) {
  if (!loop_->scenes.push(&scene)) throw Error("lesson: 64 changes wait already");
  loop_->is_called.store(true, std::memory_order_release);
}

void Lesson::again(std::uint64_t tick) {
  post(desk_->make(desk_->pages(), desk_->page_index(), desk_->options(), true, tick));
}

void Lesson::next(std::uint64_t tick) {
  const std::size_t index = (desk_->page_index() + 1) % desk_->pages().size();
  post(desk_->make(desk_->pages(), index, desk_->options(), true, tick));
}

void Lesson::begin(std::vector<PracticePage> pages, std::uint64_t tick) {
  post(desk_->make(std::move(pages), 0, desk_->options(), true, tick));
}

void Lesson::change(const LessonOptions& options, std::uint64_t tick) {
  const LessonOptions& before = desk_->options();
  LessonOptions changed = options;
  changed.mapping = before.mapping;
  changed.records_all = before.records_all;
  changed.max_absence = before.max_absence;
  post(desk_->make(desk_->pages(), desk_->page_index(), changed, options.mode != before.mode, tick));
}

const LessonView& Lesson::look() {
  LessonState state;
  const bool is_newer = loop_->states.take(state);  // first: what it says has happened is in the queues
  LessonSample sample;
  RecordedTick tick;
  // A sample is pushed before its tick, and is taken after it: so neither queue is full before the other.
  if (loop_->records_all) {
    while (loop_->ticks.pop(tick) && loop_->samples.pop(sample)) desk_->take(sample, &tick);
  } else {
    while (loop_->samples.pop(sample)) desk_->take(sample, nullptr);
  }
  LessonEvent event;
  while (loop_->events.pop(event)) desk_->take(event);
  if (is_newer) desk_->take(state);
  return desk_->view(loop_->samples.dropped(), loop_->events.dropped());
}

double Lesson::rate() const noexcept { return desk_->newest().renderer.options().servo_rate; }
const PracticePage& Lesson::page() const noexcept { return desk_->seen().page; }
const LessonOptions& Lesson::options() const noexcept { return desk_->options(); }
bool Lesson::take_event(LessonEvent& event) noexcept { return desk_->take_event(event); }
const Recording& Lesson::recording() const noexcept { return desk_->recording(); }
const std::vector<LessonHand>& Lesson::hands() const noexcept { return desk_->hands(); }
LessonWriting Lesson::writing() const { return desk_->writing(); }

}  // namespace calligraphy
