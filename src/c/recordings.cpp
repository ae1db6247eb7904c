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
    auto& samples = object<RecordingObject>(recording).recording.samples;
    samples.push_back(sample_of(read_struct(tick, "calligraphy_tick")));
  });
}
