// A stub of the vendor's runtime, written from the same public facts as the backend: a library with the functions
// of HDAPI and simulated devices inside. Three variants: complete; without some functions (WITHOUT_...); and with
// STAND_IN_IS_HELD, for programs that know nothing of it: a device held by a hand that writes STAND_IN_TEXT, in real
// time, its second motor at STAND_IN_TEMPERATURE, which must be calibrated by hand if STAND_IN_IS_UNCALIBRATED is set.
// With STAND_IN_BANNER, that is printed to standard output when the library is loaded and when the program ends.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <numbers>
#include <string>
#include <thread>
#include <vector>

#include <Eigen/Geometry>

#include <calligraphy/devices/device_profiles.hpp>
#include <calligraphy/devices/simulated_device.hpp>

#include "../stand_in.hpp"

#ifdef STAND_IN_IS_HELD
#include <calligraphy/model/character_list.hpp>

#include "../../phantom/emulator/writing_hand.hpp"
#endif

namespace {

using namespace calligraphy;

struct ErrorInfo {
  unsigned code;
  int internal_code;
  unsigned device;
};

using Callback = unsigned (*)(void*);

constexpr unsigned no_device = 0xFFFFFFFF;
constexpr unsigned invalid_enum = 0x0100;
constexpr unsigned invalid_call = 0x0102;
constexpr unsigned frame_error = 0x0402;
constexpr unsigned not_found = 0x0301;
constexpr unsigned calibration_ok = 0x5000;
constexpr unsigned needs_update = 0x5001;
constexpr unsigned needs_manual_input = 0x5002;
constexpr double period = 1e-3;  // [s]

/// Of the workspace in the runtime's coordinates, whose origin need not be there [mm].
const Eigen::Vector3d centre(5.0, 4.0, -6.0);

/// The tests compare forces with those that were set, and velocities with true ones.
Capabilities exact(Capabilities profile) {
  profile.force_step = 0.0;
  profile.velocity = VelocitySource::measured;
  return profile;
}

struct Device {
  Device(const char* device_name, const char* device_model, const char* profile, const GripImpedance& grip = {},
         const Eigen::Vector3d& position = Eigen::Vector3d::Zero())
      : name(device_name), model(device_model), physics(exact(device_profile(profile)), grip, position) {}

  std::string name, model;
  SimulatedDevice physics;
  bool open = false;
  bool in_frame = false;
  bool output = false;
  bool in_inkwell = false;
  int buttons = 0;
  unsigned calibration = calibration_ok;
  double motor_temperature = 0.0;
  Eigen::Vector3d force = Eigen::Vector3d::Zero();        ///< last one set
  DeviceState frame;                                      ///< the sample of the open frame
  std::function<Intention(const Eigen::Vector3d&)> hand;  ///< where it pulls to from this tip [m]; may be empty
  std::deque<unsigned> errors;                            ///< pending, one per frame
};

struct Scheduled {
  unsigned long handle;
  Callback callback;
  void* data;
};

struct World {
  std::recursive_mutex mutex;  ///< never held while a callback runs
  std::vector<std::unique_ptr<Device>> devices;
  std::deque<ErrorInfo> errors;
  std::list<Scheduled> callbacks;
  std::map<std::string, unsigned> failures, leftovers;
  unsigned long next_handle = 1;
  double time = 0.0;
  std::atomic<bool> running = false;
  bool real_time = false;
  int broken_rules = 0;
  std::thread thread;
};

World& world() {
  static World the_world;
  return the_world;
}

thread_local unsigned current = no_device;

using Lock = std::lock_guard<std::recursive_mutex>;

void report(unsigned code) { world().errors.push_back({code, 0, current}); }

void break_rule() {
  ++world().broken_rules;
  report(invalid_call);
}

/// Reports the error once that was asked for.
bool reports(std::map<std::string, unsigned>& asked, const char* function) {
  const auto found = asked.find(function);
  if (found == asked.end()) return false;
  report(found->second);
  asked.erase(found);
  return true;
}

bool fails(const char* function) {
  reports(world().leftovers, function);
  return reports(world().failures, function);
}

Device* open_device(unsigned handle) {
  if (handle >= world().devices.size() || !world().devices[handle]->open) return nullptr;
  return world().devices[handle].get();
}

/// The current device, within a frame.
Device* framed() {
  Device* device = open_device(current);
  if (device == nullptr || !device->in_frame) {
    break_rule();
    return nullptr;
  }
  return device;
}

void step() {
  std::vector<Scheduled> calls;
  {
    const Lock lock(world().mutex);
    if (!world().running) return;
    calls.assign(world().callbacks.begin(), world().callbacks.end());
  }
  for (const Scheduled& call : calls) {
    {
      const Lock lock(world().mutex);
      const auto same = [&](const Scheduled& other) { return other.handle == call.handle; };
      if (std::none_of(world().callbacks.begin(), world().callbacks.end(), same)) continue;
    }
    const bool goes_on = call.callback(call.data) == 1;
    const Lock lock(world().mutex);
    if (!goes_on) world().callbacks.remove_if([&](const Scheduled& other) { return other.handle == call.handle; });
  }
  const Lock lock(world().mutex);
  for (const auto& device : world().devices) {
    if (device->in_frame) ++world().broken_rules;
    device->in_frame = false;
    const bool driven = device->open && device->output && world().running;
    device->physics.write(driven ? device->force : Eigen::Vector3d(Eigen::Vector3d::Zero()));
    if (device->hand) device->physics.set_intention(device->hand(device->physics.true_position()));
    device->physics.advance(period);
  }
  world().time += period;
}

void stop_scheduler() {
  {
    const Lock lock(world().mutex);
    world().running = false;
    for (const auto& device : world().devices) device->physics.write(Eigen::Vector3d::Zero());
  }
  if (world().thread.joinable()) world().thread.join();
}

void reset() {
  stop_scheduler();
  const Lock lock(world().mutex);
  world().devices.clear();
  world().errors.clear();
  world().callbacks.clear();
  world().failures.clear();
  world().leftovers.clear();
  world().time = 0.0;
  world().real_time = false;
  world().broken_rules = 0;
  current = no_device;
}

Device& numbered(int device) { return *world().devices.at(static_cast<std::size_t>(device)); }

Eigen::Vector3d vector(const double values[3]) { return {values[0], values[1], values[2]}; }

void give(const Eigen::Vector3d& values, double result[3]) { std::copy(values.begin(), values.end(), result); }

#ifdef STAND_IN_IS_HELD
[[maybe_unused]] const bool held = [] {
  const Capabilities profile = device_profile("touch");
  const WriterSkill skill = WriterSkill::skilled();
  const char* const text = std::getenv("STAND_IN_TEXT");
  const PracticePage page =
      calligraphy_test::page_to_write(text == nullptr ? "永" : text, CharacterSet(built_in_characters()), profile);
  const auto writer = std::make_shared<calligraphy_test::WritingHand>(page, profile, skill, 1);
  auto device = std::make_unique<Device>("Default Device", "PHANTOM Touch", "touch", skill.grip, writer->start());
  device->hand = [writer](const Eigen::Vector3d& tip) { return writer->next(tip, period); };
  const char* const temperature = std::getenv("STAND_IN_TEMPERATURE");
  if (temperature != nullptr) device->motor_temperature = std::atof(temperature);
  static const char* const banner = std::getenv("STAND_IN_BANNER");
  if (banner != nullptr) {
    std::puts(banner);
    std::atexit([] { std::puts(banner); });
  }
  if (std::getenv("STAND_IN_IS_UNCALIBRATED") != nullptr) device->calibration = needs_manual_input;
  world().devices.push_back(std::move(device));
  world().real_time = true;
  return true;
}();
#endif

}  // namespace

extern "C" {

unsigned hdInitDevice(const char* name) {
  const Lock lock(world().mutex);
  if (fails("hdInitDevice")) return no_device;
  const std::string wanted = name != nullptr ? name : "Default Device";
  for (unsigned handle = 0; handle < world().devices.size(); ++handle) {
    Device& device = *world().devices[handle];
    if (device.name != wanted || device.open) continue;
    device.open = true;
    current = handle;
    return handle;
  }
  report(not_found);
  return no_device;
}

void hdMakeCurrentDevice(unsigned handle) {
  const Lock lock(world().mutex);
  if (open_device(handle) == nullptr) return break_rule();
  current = handle;
}

void hdDisableDevice(unsigned handle) {
  const Lock lock(world().mutex);
  Device* device = open_device(handle);
  if (device == nullptr || device->in_frame || device->output) return break_rule();
  device->open = false;
}

void hdBeginFrame(unsigned handle) {
  const Lock lock(world().mutex);
  Device* device = open_device(handle);
  if (device == nullptr) return break_rule();
  if (device->in_frame) {
    ++world().broken_rules;
    return report(frame_error);
  }
  device->in_frame = true;
  device->frame = device->physics.read();
  if (device->errors.empty()) return;
  world().errors.push_back({device->errors.front(), 0, handle});
  device->errors.pop_front();
}

void hdEndFrame(unsigned handle) {
  const Lock lock(world().mutex);
  Device* device = open_device(handle);
  if (device == nullptr || !device->in_frame) return break_rule();
  device->in_frame = false;
}

#ifndef WITHOUT_HD_GET_ERROR
ErrorInfo hdGetError() {
  const Lock lock(world().mutex);
  if (world().errors.empty()) return {0, 0, no_device};
  const ErrorInfo error = world().errors.front();
  world().errors.pop_front();
  return error;
}
#endif

const char* hdGetErrorString(unsigned code) { return code == not_found ? "no such device" : "an error"; }

void hdEnable(unsigned capability) {
  const Lock lock(world().mutex);
  Device* device = open_device(current);
  if (device == nullptr || capability != 0x4000) return break_rule();
  device->output = true;
}

void hdDisable(unsigned capability) {
  const Lock lock(world().mutex);
  Device* device = open_device(current);
  if (device == nullptr || capability != 0x4000) return break_rule();
  device->output = false;
  device->physics.write(Eigen::Vector3d::Zero());  // immediately, even outside a tick
}

void hdGetDoublev(unsigned what, double* values) {
  const Lock lock(world().mutex);
  if (what == 0x2050 || what == 0x2051 || what == 0x2052) {
    Device* device = framed();
    if (device == nullptr) return;
    if (what == 0x2052) {
      // The stylus leans by 30 degrees from z towards -y, and is turned by 20 about itself.
      Eigen::Isometry3d transform = Eigen::Isometry3d::Identity();
      transform.rotate(Eigen::AngleAxisd(std::numbers::pi / 6.0, Eigen::Vector3d::UnitX()));
      transform.rotate(Eigen::AngleAxisd(std::numbers::pi / 9.0, Eigen::Vector3d::UnitZ()));
      transform.translation() = 1e3 * device->frame.position + centre;
      std::copy_n(transform.data(), 16, values);
      return;
    }
    if (what == 0x2050) give(1e3 * device->frame.position + centre, values);
    if (what == 0x2051) give(1e3 * device->frame.velocity, values);
    return;
  }
  Device* device = open_device(current);
  if (device == nullptr) return break_rule();
  const Capabilities& capabilities = device->physics.capabilities();
  if (what == 0x2605) {
    if (std::isnan(device->motor_temperature)) return report(invalid_enum);
    give({0.0, device->motor_temperature, 0.0}, values);
  } else if (what == 0x2551) {
    const Eigen::Vector3d half = 0.5e3 * capabilities.workspace;
    give(centre - half, values);
    give(centre + half, values + 3);
  } else if (what == 0x2603) {
    values[0] = capabilities.peak_force;
  } else if (what == 0x2604) {
    values[0] = capabilities.continuous_force;
  } else {
    break_rule();
  }
}

void hdSetDoublev(unsigned what, const double* values) {
  const Lock lock(world().mutex);
  if (what != 0x2700) return break_rule();
  if (Device* device = framed()) device->force = vector(values);
}

void hdGetIntegerv(unsigned what, int* values) {
  const Lock lock(world().mutex);
  if (what == 0x2000) {
    if (Device* device = framed()) values[0] = device->buttons;
  } else if (what == 0x2600 && open_device(current) != nullptr) {
    values[0] = 1000;
  } else {
    break_rule();
  }
}

const char* hdGetString(unsigned what) {
  const Lock lock(world().mutex);
  Device* device = open_device(current);
  if (device == nullptr) {
    break_rule();
    return nullptr;
  }
  return what == 0x2501 ? device->model.c_str() : "540-12345";
}

unsigned hdCheckCalibration() {
  const Lock lock(world().mutex);
  Device* device = open_device(current);
  if (device == nullptr) {
    break_rule();
    return calibration_ok;
  }
  if (device->calibration == needs_manual_input && device->in_inkwell) device->calibration = needs_update;
  return device->calibration;
}

void hdUpdateCalibration(unsigned style) {
  const Lock lock(world().mutex);
  Device* device = open_device(current);
  if (device == nullptr || (style != 1 && style != 2 && style != 4)) return break_rule();
  if (style != 4 || device->in_inkwell) device->calibration = calibration_ok;
}

void hdStartScheduler() {
  const Lock lock(world().mutex);
  if (fails("hdStartScheduler")) return;
  if (world().running) return break_rule();
  world().running = true;
  if (!world().real_time) return;
  world().thread = std::thread([] {
    while (world().running) {
      step();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  });
}

void hdStopScheduler() { stop_scheduler(); }

unsigned long hdScheduleAsynchronous(Callback callback, void* data, unsigned short) {
  const Lock lock(world().mutex);
  world().callbacks.push_back({world().next_handle, callback, data});
  return world().next_handle++;
}

#ifndef WITHOUT_HD_UNSCHEDULE
void hdUnschedule(unsigned long handle) {
  const Lock lock(world().mutex);
  world().callbacks.remove_if([&](const Scheduled& scheduled) { return scheduled.handle == handle; });
}
#endif

void stand_in_control(calligraphy_test::StandInControl* control) {
  control->reset = reset;
  control->plug_in = [](const char* name, const char* model, const char* profile) {
    const Lock lock(world().mutex);
    world().devices.push_back(std::make_unique<Device>(name, model, profile));
  };
  control->run_in_real_time = [](bool real_time) { world().real_time = real_time; };
  control->step = step;
  control->time = [] {
    const Lock lock(world().mutex);
    return world().time;
  };
  control->inject = [](int device, unsigned code, int count) {
    const Lock lock(world().mutex);
    for (int i = 0; i < count; ++i) numbered(device).errors.push_back(code);
  };
  control->report = [](unsigned code) {
    const Lock lock(world().mutex);
    report(code);
  };
  control->fail = [](const char* function, unsigned code) {
    const Lock lock(world().mutex);
    world().failures[function] = code;
  };
  control->leave = [](const char* function, unsigned code) {
    const Lock lock(world().mutex);
    world().leftovers[function] = code;
  };
  control->set_calibration = [](int device, unsigned state) {
    const Lock lock(world().mutex);
    numbered(device).calibration = state;
  };
  control->set_motor_temperature = [](int device, double temperature) {
    const Lock lock(world().mutex);
    numbered(device).motor_temperature = temperature;
  };
  control->put_into_inkwell = [](int device, bool inside) {
    const Lock lock(world().mutex);
    numbered(device).in_inkwell = inside;
  };
  control->set_buttons = [](int device, int buttons) {
    const Lock lock(world().mutex);
    numbered(device).buttons = buttons;
  };
  control->set_intention = [](int device, const double position[3], const double velocity[3]) {
    const Lock lock(world().mutex);
    numbered(device).physics.set_intention({vector(position), vector(velocity)});
  };
  control->true_position = [](int device, double position[3]) {
    const Lock lock(world().mutex);
    give(numbered(device).physics.true_position(), position);
  };
  control->commanded_force = [](int device, double force[3]) {
    const Lock lock(world().mutex);
    give(numbered(device).force, force);
  };
  control->applied_force = [](int device, double force[3]) {
    const Lock lock(world().mutex);
    give(numbered(device).physics.applied_force(), force);
  };
  control->is_open = [](int device) {
    const Lock lock(world().mutex);
    return numbered(device).open;
  };
  control->output_enabled = [](int device) {
    const Lock lock(world().mutex);
    return numbered(device).output;
  };
  control->scheduler_runs = [] { return world().running.load(); };
  control->callbacks = [] {
    const Lock lock(world().mutex);
    return static_cast<int>(world().callbacks.size());
  };
  control->broken_rules = [] {
    const Lock lock(world().mutex);
    return world().broken_rules;
  };
}

}  // extern "C"
