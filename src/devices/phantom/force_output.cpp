#include "force_output.hpp"

#include <algorithm>
#include <cmath>

namespace calligraphy::phantom {
namespace {

/// Maximum torque per joint for forces of this magnitude, with the tip at the centre of the workspace [N m].
Eigen::Vector3d torque_of(const Linkage& linkage, double force) {
  const Joints middle = inverse_kinematics(linkage, linkage.centre).joints;
  return force * tip_jacobian(linkage, middle).colwise().norm().transpose();
}

}  // namespace

ForceOutput::ForceOutput(const PacketCodec& codec, const Linkage& linkage, const Capabilities& capabilities,
                         const PhantomOptions& options)
    : linkage_(linkage),
      peak_force_(capabilities.peak_force),
      limit_heat_(options.limit_heat),
      counts_(Eigen::Vector3d::Zero()),
      temperature_(codec.profile().continuous_torque.value_or(torque_of(linkage, capabilities.continuous_force)),
                   torque_of(linkage, capabilities.peak_force)) {
  const PerJoint<std::int64_t> range = codec.torque_range();
  for (std::size_t joint = 0; joint < 3; ++joint) {
    counts_[static_cast<Eigen::Index>(joint)] = static_cast<double>(range[joint]);
  }
  if (codec.profile().torque_per_count) torque_per_count_ = *codec.profile().torque_per_count;
  if (options.gravity && codec.profile().gravity) gravity_ = *codec.profile().gravity;
}

Eigen::Vector3d ForceOutput::shortened(const Eigen::Vector3d& force) const noexcept {
  if (!force.allFinite()) return Eigen::Vector3d::Zero();
  const double length = force.stableNorm();
  if (length <= peak_force_) return force;
  // Scaled first, because the length of forces near the largest double overflows.
  const Eigen::Vector3d scaled = force / force.cwiseAbs().maxCoeff();
  return scaled * (peak_force_ / scaled.norm());
}

void ForceOutput::pass_time(double seconds) noexcept {
  temperature_.advance(held_, seconds);
  const double warmest = temperature_.warmest();
  published_warmest_.store(warmest, std::memory_order_relaxed);
  overheated_ = !limit_heat_ && (warmest >= 1.0 || (overheated_ && warmest >= MotorTemperature::warm));
}

RawCommand ForceOutput::command(const Joints& joints, const Eigen::Vector3d& force, double gain) noexcept {
  RawCommand command;
  held_.setZero();
  force_.setZero();
  if (!(gain > 0.0)) return command;
  Eigen::Vector3d torque = joint_torque(linkage_, joints, force) + gain * gravity_torque(gravity_, joints);
  const double share = limit_heat_ ? temperature_.allowed_share(torque) : 1.0;
  torque *= share;
  Eigen::Vector3d counts = torque.cwiseQuotient(torque_per_count_);
  const double most = counts.cwiseAbs().cwiseQuotient(counts_).maxCoeff();
  if (!std::isfinite(most)) return command;  // joints that are not finite, or a profile without a DAC
  if (most > 1.0) counts /= most;
  force_ = share / std::max(most, 1.0) * force;
  for (Eigen::Index joint = 0; joint < 3; ++joint) {
    const std::int64_t whole = std::llround(counts[joint]);
    command.torque[static_cast<std::size_t>(joint)] = whole;
    held_[joint] = static_cast<double>(whole) * torque_per_count_[joint];
  }
  command.motors_on = true;
  return command;
}

}  // namespace calligraphy::phantom
