#include <calligraphy/practice/lesson.hpp>

#include <atomic>
#include <cstddef>
#include <utility>

#include <calligraphy/devices/latest_value.hpp>
#include <calligraphy/devices/sample_queue.hpp>
#include <calligraphy/practice/score.hpp>

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
        inputs(records_every_tick ? capacity : 1),
        machine(scene, events),
        wanted(&scene),
        records_all(records_every_tick) {}

  void obey() noexcept;
  void record(const SessionTick& session, const HapticTick& tick, const DeviceState& input,
              const LessonHand* hand) noexcept;

  SampleQueue<LessonCommand> commands;
  SampleQueue<LessonEvent> events;
  SampleQueue<LessonSample> samples;
  SampleQueue<DeviceState> inputs;  ///< of the same ticks
  LatestValue<LessonState> states;
  LessonMachine machine;
  std::atomic<LessonScene*> wanted;
  bool records_all;
  bool has_next = false;  ///< the next command
  LessonCommand next;
};

/// Carries out the commands that are due, and goes over to another scene.
void Lesson::Loop::obey() noexcept {
  const std::uint64_t tick = machine.state().tick;
  LessonScene* const scene = wanted.load(std::memory_order_acquire);
  if (scene != &machine.scene() && scene->tick <= tick && machine.can_enter(*scene)) [[unlikely]] {
    machine.enter(*scene);
  }
  if (!has_next) has_next = commands.pop(next);
  while (has_next && next.tick <= tick) [[unlikely]] {
    machine.take(next.kind);
    has_next = commands.pop(next);
  }
}

void Lesson::Loop::record(const SessionTick& session, const HapticTick& tick, const DeviceState& input,
                          const LessonHand* hand) noexcept {
  LessonHand known = hand ? *hand : LessonHand();
  known.pressure = input.stylus.pressure;
  const bool is_pushed = samples.push({session.sample(), known, tick.to_start, tick.hint, machine.ink(),
                                       machine.scene().start});
  if (records_all && is_pushed) inputs.push(session.input(input));
}

Lesson::Lesson(std::vector<PracticePage> pages, const Capabilities& device, const LessonOptions& options)
    : desk_(std::make_unique<LessonDesk>(std::move(pages), device, options)),
      loop_(std::make_unique<Loop>(desk_->newest(), desk_->capacity(), options.records_all)) {}

Lesson::~Lesson() = default;

const HapticTick& Lesson::update(const DeviceState& sample, const LessonHand* hand) noexcept {
  Loop& loop = *loop_;
  LessonMachine& machine = loop.machine;
  loop.obey();
  SessionTick& session = machine.scene().session;
  const DeviceState* seen = &sample;
  DeviceState silent;
  if (!machine.sees_pen()) [[unlikely]] {
    silent = sample;
    silent.status = DeviceStatus::stale;
    seen = &silent;
  }
  const HapticTick& tick = session.update(*seen);
  if (hand) machine.set_hand(hand->place);
  machine.update(tick);
  if (machine.ink() >= 0 || tick.events != TickEvent::none || loop.records_all) loop.record(session, tick, *seen, hand);
  if (machine.take_change() || machine.state().tick % ticks_of_a_look == 0) loop.states.publish(machine.state());
  return tick;
}

const Eigen::Vector3d& Lesson::force() const noexcept { return loop_->machine.scene().session.force(); }
void Lesson::ignore() noexcept { loop_->machine.take(LessonCommandKind::ignore); }
bool Lesson::is_waiting() const noexcept { return loop_->machine.is_waiting(); }
bool Lesson::has_commands() const noexcept {
  return loop_->has_next || !loop_->commands.is_empty() ||
         loop_->wanted.load(std::memory_order_relaxed) != &loop_->machine.scene();
}
std::exception_ptr Lesson::law_error() const { return loop_->machine.scene().session.error(); }

bool Lesson::send(const LessonCommand& command) noexcept { return loop_->commands.push(command); }

void Lesson::again(std::uint64_t tick) {
  loop_->wanted = &desk_->make(desk_->pages(), desk_->page_index(), desk_->options(), true, tick);
}

void Lesson::next(std::uint64_t tick) {
  const std::size_t index = (desk_->page_index() + 1) % desk_->pages().size();
  loop_->wanted = &desk_->make(desk_->pages(), index, desk_->options(), true, tick);
}

void Lesson::begin(std::vector<PracticePage> pages, std::uint64_t tick) {
  loop_->wanted = &desk_->make(std::move(pages), 0, desk_->options(), true, tick);
}

void Lesson::change(const LessonOptions& options, std::uint64_t tick) {
  const LessonOptions& before = desk_->options();
  LessonOptions changed = options;
  changed.mapping = before.mapping;
  changed.records_all = before.records_all;
  changed.max_absence = before.max_absence;
  loop_->wanted = &desk_->make(desk_->pages(), desk_->page_index(), changed, options.mode != before.mode, tick);
}

const LessonView& Lesson::look() {
  LessonSample sample;
  DeviceState input;
  // A sample is pushed before its input, and is taken after it: so neither queue is full before the other.
  if (loop_->records_all) {
    while (loop_->inputs.pop(input) && loop_->samples.pop(sample)) desk_->take(sample, &input);
  } else {
    while (loop_->samples.pop(sample)) desk_->take(sample, nullptr);
  }
  LessonEvent event;
  while (loop_->events.pop(event)) desk_->take(event);
  LessonState state;
  if (loop_->states.take(state)) desk_->take(state);
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
