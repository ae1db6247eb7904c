#include <calligraphy/practice/recording.hpp>

#include <limits>

namespace calligraphy {

std::vector<DeviceState> device_states(const Recording& recording, const MotionMapping& mapping) {
  std::vector<DeviceState> result;
  result.reserve(recording.samples.size());
  for (const RecordedSample& sample : recording.samples) {
    DeviceState state;
    state.time = sample.time;
    state.position = mapping.to_device(sample.device_point);
    // A fault is replayed as a fault: the sample holds the last good point.
    if (sample.status == TickStatus::bad_sample) state.position.setConstant(std::numeric_limits<double>::quiet_NaN());
    if (sample.status == TickStatus::stale) state.status = DeviceStatus::stale;
    if (sample.status == TickStatus::device_fault) state.status = DeviceStatus::fault;
    result.push_back(state);
  }
  return result;
}

}  // namespace calligraphy
