// Where the Phantom backend was left out: its names are there, and say what to install.
#include <cstdlib>

#include <calligraphy/base/error.hpp>
#include <calligraphy/devices/phantom/capture.hpp>
#include <calligraphy/devices/phantom/device_list.hpp>
#include <calligraphy/devices/phantom/phantom_device.hpp>
#include <calligraphy/devices/phantom/wire_profile.hpp>

namespace calligraphy {
namespace {

[[noreturn]] void refuse() {
  throw DeviceError(
      "this module was built without Phantoms: install libusb-1.0 and hidapi with their headers (Debian: "
      "libusb-1.0-0-dev libhidapi-dev pkg-config), then calligraphy again with CALLIGRAPHY_PHANTOM=ON, which says what "
      "is missing");
}

}  // namespace

std::string describe(const PluggedDevice&) { refuse(); }
std::vector<PluggedDevice> plugged_devices() { refuse(); }
std::string dump_descriptors(const PluggedDevice&) { refuse(); }
Capture capture(const PluggedDevice&, const CaptureOptions&) { refuse(); }
void write_capture(std::ostream&, const Capture&) { refuse(); }

namespace phantom {

std::vector<std::string> wire_profile_names() { refuse(); }
const WireProfile& wire_profile(std::string_view) { refuse(); }
std::string_view wire_profile_text(std::string_view) { refuse(); }
WireProfile read_wire_profile(const std::string&) { refuse(); }
std::vector<std::string> missing_for_position(const WireProfile&) { refuse(); }
std::vector<std::string> missing_for_force(const WireProfile&) { refuse(); }

}  // namespace phantom

class PhantomDevice::Core {};

PhantomDevice::PhantomDevice(const PhantomOptions&) { refuse(); }

// Of a device that nobody can have.
PhantomDevice::~PhantomDevice() = default;
const Capabilities& PhantomDevice::capabilities() const noexcept { std::abort(); }
DeviceState PhantomDevice::read() noexcept { std::abort(); }
void PhantomDevice::write(const Eigen::Vector3d&) noexcept { std::abort(); }
void PhantomDevice::close() noexcept { std::abort(); }
void PhantomDevice::calibrate(const phantom::Joints&) { std::abort(); }
const phantom::Joints& PhantomDevice::joints() const noexcept { std::abort(); }
bool PhantomDevice::docked() const noexcept { std::abort(); }
PhantomStatistics PhantomDevice::statistics() const noexcept { std::abort(); }
const std::string& PhantomDevice::description() const noexcept { std::abort(); }

}  // namespace calligraphy
