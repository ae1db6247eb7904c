#include <vector>

#include <calligraphy/devices/replay_device.hpp>
#include <calligraphy/practice/recording.hpp>

#include "../catch.hpp"

using namespace calligraphy;

TEST_CASE("device states are the device points in device axes, and faults and stale samples stay what they are",
          "[practice]") {
  MotionMapping mapping = desk_page(0.16, 0.12);
  mapping.scale = 2.0;
  Recording recording;
  for (int i = 0; i < 5; ++i) {
    RecordedSample sample;
    sample.time = 0.25 * i;
    sample.device_point = {0.1 * i, 0.05, -0.001 * i};
    sample.pen_tip = {9, 9, 9};
    recording.samples.push_back(sample);
  }
  recording.samples[1].status = TickStatus::bad_sample;
  recording.samples[2].status = TickStatus::device_fault;
  recording.samples[3].status = TickStatus::stale;
  const std::vector<DeviceState> states = device_states(recording, mapping);
  REQUIRE(states.size() == 5);
  for (std::size_t i = 0; i < 5; ++i) {
    CAPTURE(i);
    const RecordedSample& sample = recording.samples[i];
    CHECK(states[i].time == sample.time);
    CHECK(states[i].velocity.array().isNaN().all());
    CHECK(states[i].status == (i == 2 ? DeviceStatus::fault : i == 3 ? DeviceStatus::stale : DeviceStatus::ok));
    if (i == 1) {
      CHECK(states[i].position.array().isNaN().all());
    } else {
      CHECK((mapping.to_page(states[i].position) - sample.device_point).norm() < 1e-15);
    }
  }
  ReplayDevice device(states, {});
  while (!device.finished()) CHECK(device.read().velocity.allFinite());
}
