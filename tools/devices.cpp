// calligraphy devices: connected devices, access permissions and how to obtain them, and what one device sends.
#include <chrono>
#include <cstdio>
#include <memory>
#include <numbers>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <calligraphy/base/error.hpp>
#include <calligraphy/devices/device_profiles.hpp>
#include <calligraphy/devices/sample_queue.hpp>
#include <calligraphy/devices/servo_loop.hpp>
#ifdef CALLIGRAPHY_WITH_PHANTOM
#include <calligraphy/devices/phantom/device_list.hpp>
#include <calligraphy/devices/phantom/packet_capture.hpp>
#include <calligraphy/devices/phantom/phantom_device.hpp>
#include <calligraphy/devices/phantom/wire_profile.hpp>
#endif
#ifdef CALLIGRAPHY_WITH_OPENHAPTICS
#include <calligraphy/devices/openhaptics/openhaptics_device.hpp>
#endif

#include "advice_teller.hpp"
#include "base/monotonic_clock.hpp"
#include "commands.hpp"
#include "device_choice.hpp"
#include "help_page.hpp"
#include "interrupt.hpp"
#include "options.hpp"
#include "output_file.hpp"
#include "servo_report.hpp"
#include "stop_key.hpp"

namespace calligraphy::tools {
namespace {

using Json = nlohmann::ordered_json;

/// What one backend found, as text and as JSON.
struct Section {
  std::string text;
  Json json;
};

#ifdef CALLIGRAPHY_WITH_PHANTOM
std::string ids(const PluggedDevice& device) {
  return fmt::format("{:04x}:{:04x}", device.vendor_id, device.product_id);
}

Section phantoms() {
  const std::vector<PluggedDevice> devices = plugged_devices();
  Section section{devices.empty() ? "phantom: none connected (2988:0302, 0301:2988, 2988:0304)\n" : "", Json::array()};
  for (const PluggedDevice& device : devices) {
    section.text += fmt::format("phantom:{}  {}  {}, {} on bus {} port {}\n  {}: {}\n", device.serial, ids(device),
                                device.model, to_string(device.link), device.bus, device.port,
                                fmt::join(device.nodes, ", "), device.may_open ? "access permitted" : "access DENIED");
    if (!device.advice.empty()) section.text += "  " + wrapped(device.advice, 2, 2, help_width());
    section.json.push_back({{"device", "phantom" + (device.serial.empty() ? "" : ":" + device.serial)},
                            {"ids", ids(device)},
                            {"model", device.model},
                            {"link", to_string(device.link)},
                            {"bus", device.bus},
                            {"port", device.port},
                            {"nodes", device.nodes},
                            {"serial", device.serial},
                            {"may_open", device.may_open},
                            {"advice", device.advice}});
  }
  return section;
}
#else
Section phantoms() {
  return {"phantom: this program was built without the backend (CALLIGRAPHY_PHANTOM=ON)\n", Json()};
}
#endif

#ifdef CALLIGRAPHY_WITH_OPENHAPTICS
Section vendor_runtime() {
  keep_output_to_ourselves();
  const OpenHapticsRuntime runtime = openhaptics_runtime();
  if (runtime.found) {
    return {fmt::format("openhaptics: {}\n", runtime.library), {{"found", true}, {"library", runtime.library}}};
  }
  const std::string head = "openhaptics: ";
  return {head + wrapped(runtime.advice, head.size(), 2, help_width()), {{"found", false}, {"advice", runtime.advice}}};
}
#else
Section vendor_runtime() {
  return {"openhaptics: this program was built without the backend (CALLIGRAPHY_OPENHAPTICS=ON)\n", Json()};
}
#endif

Section simulated() {
  Section section{fmt::format("simulated: {}\n", device_names()), Json::array()};
  for (const Capabilities& profile : device_profiles()) section.json.push_back("simulated:" + profile.name);
  return section;
}

void list(bool as_json) {
  const Section phantom = phantoms(), openhaptics = vendor_runtime(), profiles = simulated();
  if (as_json) {
    const Json all = {{"phantom", phantom.json}, {"openhaptics", openhaptics.json}, {"simulated", profiles.json}};
    fmt::print(output(), "{}\n", all.dump(2));
  } else {
    fmt::print(output(), "{}{}{}", phantom.text, openhaptics.text, profiles.text);
  }
}

struct ProbeOptions {
  std::string serial;
  std::string out;
  double seconds = 10.0;
};

#ifdef CALLIGRAPHY_WITH_PHANTOM
PluggedDevice chosen_phantom(const std::string& serial) {
  const std::vector<PluggedDevice> devices = plugged_devices();
  if (serial.empty() && devices.size() == 1) return devices.front();
  std::string there;
  for (const PluggedDevice& device : devices) {
    if (!serial.empty() && device.serial == serial) return device;
    there += (there.empty() ? "" : "; ") + describe_device(device);
  }
  const std::string wanted = serial.empty() ? "" : " with serial number " + serial;
  if (devices.empty()) throw DeviceError("no Phantom" + wanted + " is connected");
  throw DeviceError(serial.empty() ? "several Phantoms are connected; specify a serial number: " + there
                                   : "no Phantom" + wanted + " is connected; available: " + there);
}

/// Writes the descriptors first: they need no permission and are useful even if the device cannot be opened.
void probe(const ProbeOptions& options) {
  const PluggedDevice device = chosen_phantom(options.serial);
  check_output(options.out);
  const Interrupt interrupt;
  std::ostringstream text;
  text << "# " << describe_device(device) << "\n" << dump_descriptors(device);
  std::string failure;
  std::size_t transfers = 0;
  try {
    CaptureOptions limits;
    limits.seconds = options.seconds;
    limits.transfers = 1000000;
    limits.stop = [&interrupt] { return interrupt.asked(); };
    const PacketCapture captured = capture_packets(device, limits);
    transfers = captured.transfers.size();
    write_packet_capture(text, captured);
  } catch (const DeviceError& error) {
    failure = error.what();
    text << "# " << failure << "\n";
  }
  write_output(options.out, text.str());
  if (!failure.empty()) throw DeviceError(failure + "; only the descriptors were written to " + options.out);
  std::FILE* const told = options.out == standard_output ? stderr : output();
  fmt::print(told, "{}: descriptors and {} transfers written to {}\n", describe_device(device), transfers, options.out);
}
#else
void probe(const ProbeOptions&) {
  throw UsageError("devices probe: this program was built without the phantom backend (CALLIGRAPHY_PHANTOM=ON)");
}
#endif

struct WatchOptions {
  std::string device;
  std::string wire_profile;
  std::string model;
  double seconds = 0.0;  ///< 0: until Ctrl-C
};

struct Sighting {
  DeviceState state;
  Eigen::Vector3d joints = Eigen::Vector3d::Zero();  ///< joint angles of a Phantom [rad]
};

/// Hands out every sample of a device, including those on which the force law is not called: uncalibrated or faulty.
class SeenDevice final : public HapticDevice {
 public:
  explicit SeenDevice(HapticDevice& device) : device_(device) {
#ifdef CALLIGRAPHY_WITH_PHANTOM
    phantom_ = dynamic_cast<const PhantomDevice*>(&device);
#endif
  }

  const Capabilities& capabilities() const noexcept override { return device_.capabilities(); }
  DeviceState read() noexcept override {
    Sighting seen{device_.read()};
#ifdef CALLIGRAPHY_WITH_PHANTOM
    if (phantom_ != nullptr) seen.joints = phantom_->joints();
#endif
    queue_.push(seen);
    return seen.state;
  }
  void write(const Eigen::Vector3d& force) noexcept override { device_.write(force); }
  void close() noexcept override { device_.close(); }
  ServoClock* clock() noexcept override { return device_.clock(); }
  std::vector<std::string> warnings() const override { return device_.warnings(); }
  std::string advice() const override { return device_.advice(); }

  /// Called by the watching thread.
  void look(Sighting& newest) {
    while (queue_.pop(newest)) {
    }
  }
  bool has_joints() const {
#ifdef CALLIGRAPHY_WITH_PHANTOM
    return phantom_ != nullptr;
#else
    return false;
#endif
  }

 private:
  HapticDevice& device_;
#ifdef CALLIGRAPHY_WITH_PHANTOM
  const PhantomDevice* phantom_ = nullptr;
#endif
  SampleQueue<Sighting> queue_{4096};
};

std::string angles(const Eigen::Vector3d& joints) {
  const Eigen::Vector3d q = 180.0 / std::numbers::pi * joints;
  return fmt::format("  joints {:7.2f} {:7.2f} {:7.2f} deg", q[0], q[1], q[2]);
}

/// Only reads: the force law returns zero.
void watch(const WatchOptions& options) {
  DeviceChoice choice = device_choice(options.device);
  if (choice.kind != DeviceKind::phantom && choice.kind != DeviceKind::openhaptics) {
    throw UsageError("DEVICE: " + options.device + ": expected phantom[:SERIAL] or openhaptics[:NAME]");
  }
  choice.wire_profile = options.wire_profile;
  choice.model = options.model;
  const std::unique_ptr<HapticDevice> device = open_device(choice, false);
  SeenDevice seen(*device);
  ServoLoop loop(seen, [](const DeviceState&) { return Eigen::Vector3d(Eigen::Vector3d::Zero()); });
  const Interrupt interrupt;
  StopKey key;
  fmt::print(output(), "{}, without force; {} stops\n", device->capabilities().model, stop_keys(key));
  for (const std::string& warning : loop.start()) spdlog::warn("{}", warning);
  const double begin = monotonic_seconds();
  Sighting newest;
  AdviceTeller advice;
  while (!interrupt.asked() && !key.pressed() &&
         (options.seconds == 0.0 || monotonic_seconds() - begin < options.seconds)) {
    std::this_thread::sleep_for(std::chrono::milliseconds(250));
    seen.look(newest);
    key.look();
    advice.look(seen.advice());
    const ServoStatus status = loop.status();
    const Eigen::Vector3d p = 1e3 * newest.state.position;
    fmt::print(output(), "x {:8.2f}  y {:8.2f}  z {:8.2f} mm{}  buttons {:04b}  {}{}{}  {} stale of {} ticks\n", p.x(),
               p.y(), p.z(), seen.has_joints() ? angles(newest.joints) : "", newest.state.buttons,
               to_string(status.device), status.fault == DeviceFault::none ? "" : ": ",
               status.fault == DeviceFault::none ? "" : to_string(status.fault), loop.statistics().stale_samples,
               loop.statistics().ticks);
    std::fflush(output());
  }
  loop.stop();
  fmt::print(output(), "{}", lines(loop.statistics()));
}

}  // namespace

void add_devices(CLI::App& program) {
  CLI::App* const command = program.add_subcommand(
      "devices", "List the devices available to `write --device`, and how to obtain access to them.");
  command->footer(
      "calligraphy devices\n"
      "calligraphy devices watch phantom --wire-profile mine.profile\n"
      "# mine.profile: see `calligraphy help devices profile`");
  const auto as_json = std::make_shared<bool>(false);
  command->add_flag("--json", *as_json, "Print JSON instead of text")->disable_flag_override();
  command->require_subcommand(0, 1);

  CLI::App* const prober =
      command->add_subcommand("probe",
                              "Capture the descriptors and packets of a Phantom in a text file, as the basis for a "
                              "wire profile. No commands are sent to the device.");
  const auto probe_options = std::make_shared<ProbeOptions>();
  prober->add_option("SERIAL", probe_options->serial, "Serial number, required if several are connected");
  add_out_file(*prober, probe_options->out);
  prober->footer("calligraphy devices probe --out probe.txt");
  prober->add_option("--seconds", probe_options->seconds, "Duration of the capture, 0.1 to 600")
      ->check(number(0.1, 600.0))
      ->capture_default_str()
      ->type_name("S");
  prober->callback([probe_options] { probe(*probe_options); });

#ifdef CALLIGRAPHY_WITH_PHANTOM
  CLI::App* const profiles = command->add_subcommand(
      "profile",
      "Print a wire profile shipped with the library, as a starting point for your own. Shipped "
      "profiles lack the calibration of your device, without which there are no positions and "
      "no forces: docs/wire-profile.md.");
  profiles->footer("calligraphy devices profile omni > mine.profile    # then add the calibration");
  const auto profile = std::make_shared<std::string>();
  profiles
      ->add_option("NAME", *profile,
                   fmt::format("Name of the profile: {}", fmt::join(phantom::wire_profile_names(), ", ")))
      ->required()
      ->check(CLI::IsMember(phantom::wire_profile_names()));
  profiles->callback([profile] { fmt::print(output(), "{}", phantom::wire_profile_text(*profile)); });
#endif

  CLI::App* const watcher = command->add_subcommand(
      "watch", "Show position, buttons and status of a device four times a second, without force.");
  watcher->footer(
      "calligraphy devices watch phantom --wire-profile mine.profile --seconds 10\n"
      "# mine.profile: see `calligraphy help devices profile`");
  const auto watch_options = std::make_shared<WatchOptions>();
  watcher->add_option("DEVICE", watch_options->device, "phantom[:SERIAL] or openhaptics[:NAME]")
      ->required()
      ->check(such_as({"phantom", "openhaptics"}));
  add_phantom_options(*watcher, watch_options->wire_profile, watch_options->model);
  watcher
      ->add_option("--seconds", watch_options->seconds, "Duration, 0.1 to 86400 (default: until space, Esc or Ctrl-C)")
      ->check(number(0.1, 86400.0))
      ->type_name("S");
  watcher->callback([watch_options] { watch(*watch_options); });

  command->callback([command, as_json] {
    if (command->get_subcommands().empty()) list(*as_json);
  });
}

}  // namespace calligraphy::tools
