#include <string>

#include "conversions.hpp"
#include "objects.hpp"
#include "structs.hpp"

namespace calligraphy::c {
namespace {

RecordedSample sample_of(const calligraphy_tick& tick) {
  RecordedSample sample;
  sample.time = tick.time;
  sample.device_point = Eigen::Vector3d(tick.device_point);
  sample.pen_tip = Eigen::Vector3d(tick.pen_tip);
  sample.force = Eigen::Vector3d(tick.page_force);
  sample.state = enumeration("state", tick.state, InteractionState::writing);
  sample.events = static_cast<TickEvent>(tick.events);
  sample.status = enumeration("status", tick.status, TickStatus::bad_law);
  sample.character = tick.character;
  sample.stroke = tick.stroke;
  return sample;
}

/// @throws Refusal unless the next tick is like those before it
void require_same(const Recording& recording, bool is_same, const char* others) {
  if (is_same) return;
  throw Refusal(CALLIGRAPHY_INVALID_VALUE, "the recording has " + std::to_string(recording.samples.size()) + " ticks " +
                                               others + " their samples: it has those of all ticks or of none");
}

}  // namespace
}  // namespace calligraphy::c

using namespace calligraphy;
using namespace calligraphy::c;

calligraphy_status calligraphy_recording_create(const calligraphy_page* page, double rate,
                                                calligraphy_recording** recording) {
  return guarded([&] {
    auto made = std::make_shared<RecordingObject>();
    made->page = shared_object<PracticePage>(page);
    set_if_given(made->recording.rate, rate, "rate", "Hz");
    target(recording, "recording");
    hand_out(recording, std::move(made));
  });
}

calligraphy_status calligraphy_recording_add(calligraphy_recording* recording, const calligraphy_tick* tick) {
  return guarded([&] {
    Recording& into = object<RecordingObject>(recording).recording;
    const RecordedSample sample = sample_of(read_struct(tick, "calligraphy_tick"));
    require_same(into, into.inputs.empty(), "with");
    into.samples.push_back(sample);
  });
}

calligraphy_status calligraphy_recording_add_with_input(calligraphy_recording* recording, const calligraphy_tick* tick,
                                                        const calligraphy_device_state* input) {
  return guarded([&] {
    Recording& into = object<RecordingObject>(recording).recording;
    const RecordedSample sample = sample_of(read_struct(tick, "calligraphy_tick"));
    const calligraphy_device_state given = read_struct(input, "calligraphy_device_state");
    require_same(into, into.inputs.size() == into.samples.size(), "without");
    into.inputs.push_back(state_of(&given));
    try {
      into.samples.push_back(sample);
    } catch (...) {
      into.inputs.pop_back();
      throw;
    }
  });
}

calligraphy_status calligraphy_recording_input(const calligraphy_recording* recording, int32_t tick,
                                               calligraphy_device_state* input) {
  return guarded([&] {
    const DeviceState& found = item("tick", object<RecordingObject>(recording).recording.inputs, tick);
    write_struct(input, "calligraphy_device_state", to_c(found));
  });
}
