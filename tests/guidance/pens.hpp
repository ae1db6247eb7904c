// Pens that draw given lines on a page without seeing it: one that is exactly where it is meant to be, and one that a
// hand holds on a simulated device.
#pragma once

#include <functional>
#include <vector>

#include <calligraphy/devices/simulated_device.hpp>
#include <calligraphy/render/haptic_renderer.hpp>

#include "stroke_line.hpp"

namespace calligraphy_test {

inline constexpr double people_speed = 0.66;  ///< mean, along a stroke [em/s]

/// What became of one line that was drawn, from the touch to the lift.
struct Drawn {
  bool started = false;   ///< a stroke
  bool finished = false;  ///< a stroke
  bool went_on = false;   ///< finished a stroke in the tick in which it started the next
};

/// A pen and the renderer that it writes on.
class Pen {
 public:
  virtual ~Pen() = default;

  /// Brings the pen over the start, lowers it, draws by the two-thirds law (Lacquaniti, Terzuolo and Viviani, 1983: the
  /// speed falls with the cube root of the curvature), and raises it: in the air for at least 0.3 s, 8 mm above the
  /// paper.
  Drawn draw(const StrokeLine& line, double em);
  /// Stays where it is, in the air once it has drawn.
  Drawn rest(double seconds);

  std::size_t written() const;  ///< strokes of the page, so that this is the index of the due one
  const calligraphy::HapticTick& last() const { return renderer_.last(); }
  std::function<void(const calligraphy::HapticTick&)> on_tick;  ///< while it draws

 protected:
  Pen(const calligraphy::PracticePage& page, const calligraphy::Capabilities& device,
      const calligraphy::RendererOptions& options);

  static constexpr double raised = 0.008;  ///< [m]

  /// Means to be at `to` after one tick.
  virtual void step(const Eigen::Vector3d& to) = 0;

  calligraphy::HapticRenderer renderer_;
  std::vector<std::size_t> stroke_counts_;     ///< of the characters
  double period_;                              ///< [s]
  double pressed_ = 0.001;                     ///< how far below the paper the pen is meant to be [m]
  Eigen::Vector3d intended_ = {0, 0, raised};  ///< [m, page]

 private:
  void go(const Eigen::Vector3d& to, double seconds);
  void step_and_see(const Eigen::Vector3d& to);

  Drawn drawn_;
};

/// Is where it is meant to be, whatever the force.
class KinematicPen final : public Pen {
 public:
  KinematicPen(const calligraphy::PracticePage& page, const calligraphy::Capabilities& device,
               const calligraphy::RendererOptions& options)
      : Pen(page, device, options) {}

 private:
  void step(const Eigen::Vector3d& to) override;

  double time_ = 0.0;
};

/// What a hand does about the device that it holds.
enum class Arm {
  skilled,  ///< carries its mass and friction: without guidance the tip goes where it is meant to go
  naive     ///< leaves them to the spring of its grip: friction of 0.26 N stops the tip 0.9 mm short
};

/// On a device, in a hand that feels the force, or not.
class HeldPen final : public Pen {
 public:
  HeldPen(const calligraphy::PracticePage& page, const calligraphy::Capabilities& device,
          const calligraphy::RendererOptions& options, const calligraphy::GripImpedance& grip, Arm arm, bool feels);

 private:
  void step(const Eigen::Vector3d& to) override;
  Eigen::Vector3d lead(const Eigen::Vector3d& velocity, const Eigen::Vector3d& acceleration) const;

  calligraphy::SimulatedDevice device_;
  calligraphy::GripImpedance grip_;
  Arm arm_;
  bool feels_;
  Eigen::Vector3d meant_ = Eigen::Vector3d::Zero();     ///< as told to the device, lead included [m, device]
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();  ///< of the intention, without the lead [m/s, device]
};

}  // namespace calligraphy_test
