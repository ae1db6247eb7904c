// Where the OpenHaptics backend was left out: its names are there, and say what to do.
#include <cstdlib>

#include <calligraphy/base/error.hpp>
#include <calligraphy/devices/openhaptics/openhaptics_device.hpp>

namespace calligraphy {
namespace {

constexpr char advice_text[] =
    "this module was built without OpenHaptics: install calligraphy again with CALLIGRAPHY_OPENHAPTICS=ON, on a system "
    "with dlopen, and the vendor's runtime";

}  // namespace

OpenHapticsRuntime openhaptics_runtime(const std::string&) { return {false, "", advice_text}; }
std::string openhaptics_error_name(std::uint32_t) { throw DeviceError(advice_text); }

class OpenHapticsDevice::Implementation {};

OpenHapticsDevice::OpenHapticsDevice(const OpenHapticsOptions&) { throw DeviceError(advice_text); }

// Of a device that nobody can have.
OpenHapticsDevice::~OpenHapticsDevice() = default;
const Capabilities& OpenHapticsDevice::capabilities() const noexcept { std::abort(); }
DeviceState OpenHapticsDevice::read() noexcept { std::abort(); }
void OpenHapticsDevice::write(const Eigen::Vector3d&) noexcept { std::abort(); }
void OpenHapticsDevice::close() noexcept { std::abort(); }
ServoClock* OpenHapticsDevice::clock() noexcept { std::abort(); }
const std::string& OpenHapticsDevice::serial() const noexcept { std::abort(); }
const std::string& OpenHapticsDevice::library() const noexcept { std::abort(); }
std::uint32_t OpenHapticsDevice::last_error() const noexcept { std::abort(); }
std::string OpenHapticsDevice::advice() const { std::abort(); }

}  // namespace calligraphy
