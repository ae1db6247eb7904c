// A writer, a device and a renderer in closed loop, in virtual time.
#pragma once

#include <cstdint>
#include <functional>

#include <calligraphy/devices/simulated_device.hpp>
#include <calligraphy/practice/page.hpp>
#include <calligraphy/practice/recording.hpp>
#include <calligraphy/practice/writer.hpp>
#include <calligraphy/render/haptic_renderer.hpp>

namespace calligraphy {

/// The two modes of the paper's experiment (sec. 7.1).
enum class Mode {
  vision,  ///< the force stays at the renderer: the device is told zero
  force    ///< vision and force
};

struct SessionOptions {
  Mode mode = Mode::force;
  DeviceProfile device;
  RendererOptions renderer;
  WriterSkill skill;
  std::uint64_t seed = 1;
  bool measure_ticks = false;      ///< reads the clock round every tick of the renderer
  double longest_character = 120;  ///< virtual time after which a character is given up, per character [s]
  std::function<void(double)> progress = nullptr;  ///< called now and then with the share of characters written
};

/// Writes the page once. Deterministic per seed, measured times aside.
/// @throws ValueError when an option is out of its domain
Recording write_page(const Page& page, const SessionOptions& options);

}  // namespace calligraphy
