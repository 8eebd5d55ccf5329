// SPDX-License-Identifier: MIT
#include "tracking/pose_graph.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>

namespace dynamic_filter {
namespace {

using Block = Eigen::Matrix<double, 6, 6>;
using Entries = std::vector<Eigen::Triplet<double>>;

constexpr int kMostSolutions = 30;
constexpr double kSolved = 1e-5;  // [m], [rad]
// Squared error, in multiples of what its information expects, at which a doubtful observation has
// a quarter of its weight. It is reached in steps, from a value at which all have nearly full
// weight (graduated non-convexity with the Geman-McClure kernel).
constexpr double kStrict = 12.0, kLenient = 1e4, kStricter = 0.5;

/// Normal equations of a step of Gauss-Newton.
struct Equations {
    Entries entries;
    Eigen::VectorXd b;

    void add(std::size_t row, std::size_t column, const Block& block) {
        for (int r = 0; r < 6; ++r) {
            for (int c = 0; c < 6; ++c) {
                entries.emplace_back(static_cast<int>(6 * row) + r,
                                     static_cast<int>(6 * column) + c, block(r, c));
            }
        }
    }
    auto part(std::size_t scan) { return b.segment<6>(static_cast<Eigen::Index>(6 * scan)); }
};

/// Displacement of a point of the frame `b` of T_a_b, seen in the frame `a`.
Block adjoint(const Pose& T_a_b) {
    const Eigen::Vector3d t = T_a_b.translation();
    Eigen::Matrix3d cross;
    cross << 0, -t.z(), t.y(), t.z(), 0, -t.x(), -t.y(), t.x(), 0;
    Block result = Block::Zero();
    result.topLeftCorner<3, 3>() = result.bottomRightCorner<3, 3>() = T_a_b.linear();
    result.topRightCorner<3, 3>() = cross * T_a_b.linear();
    return result;
}

/// Weight of an observation with this squared error.
double weight_of(double squared, double scale) {
    const double share = scale / (scale + squared);
    return share * share;
}

/// The error of a motion is log(T_from_to^-1 T_from^-1 T_to), whose derivative is the identity for
/// a displacement of `to`, and minus the adjoint for one of `from`, as long as the error is small.
void add(Equations& sums, const Motion& motion, const std::vector<Pose>& poses, double scale) {
    const Pose T_from_to = poses[motion.from].inverse() * poses[motion.to];
    const Twist error = log(motion.T_from_to.inverse() * T_from_to);
    const double squared = error.dot(motion.information * error);
    const Block W = (motion.is_doubtful ? weight_of(squared, scale) : 1.0) * motion.information;
    const Block A = -adjoint(T_from_to.inverse());
    sums.add(motion.from, motion.from, A.transpose() * W * A);
    sums.add(motion.from, motion.to, A.transpose() * W);
    sums.add(motion.to, motion.from, W * A);
    sums.add(motion.to, motion.to, W);
    sums.part(motion.from) -= A.transpose() * W * error;
    sums.part(motion.to) -= W * error;
}

void add(Equations& sums, const PoseHint& hint, const std::vector<Pose>& poses, double scale) {
    const Twist error = log(hint.T_world_sensor.inverse() * poses[hint.scan]);
    const Block W = weight_of(error.dot(hint.information * error), scale) * hint.information;
    sums.add(hint.scan, hint.scan, W);
    sums.part(hint.scan) -= W * error;
}

Equations linearise(const std::vector<Pose>& poses, std::span<const Motion> motions,
                    std::span<const PoseHint> hints, double scale) {
    constexpr double kHold = 1e8, kFaint = 1e-9;
    Equations sums;
    sums.b = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(6 * poses.size()));
    for (const Motion& motion : motions) add(sums, motion, poses, scale);
    for (const PoseHint& hint : hints) add(sums, hint, poses, scale);
    // Without hints, the trajectory as a whole could be anywhere.
    if (hints.empty()) sums.add(0, 0, kHold * Block::Identity());
    // Keeps what nothing is known about where it is.
    for (std::size_t i = 0; i < poses.size(); ++i) sums.add(i, i, kFaint * Block::Identity());
    return sums;
}

}  // namespace

std::vector<Pose> solve_pose_graph(std::vector<Pose> start, std::span<const Motion> motions,
                                   std::span<const PoseHint> hints) {
    std::vector<Pose> poses = std::move(start);
    if (poses.empty()) return poses;
    const auto size = static_cast<Eigen::Index>(6 * poses.size());
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver;
    double scale = kLenient;
    for (int i = 0; i < kMostSolutions; ++i) {
        Equations sums = linearise(poses, motions, hints, scale);
        Eigen::SparseMatrix<double> H(size, size);
        H.setFromTriplets(sums.entries.begin(), sums.entries.end());
        if (i == 0) solver.analyzePattern(H);
        solver.factorize(H);
        if (solver.info() != Eigen::Success) return poses;
        const Eigen::VectorXd step = solver.solve(sums.b);
        for (std::size_t k = 0; k < poses.size(); ++k) {
            poses[k] = poses[k] * exp(step.segment<6>(static_cast<Eigen::Index>(6 * k)));
            const Eigen::Quaterniond rotation(poses[k].linear());
            poses[k].linear() = rotation.normalized().toRotationMatrix();
        }
        if (scale <= kStrict && step.lpNorm<Eigen::Infinity>() < kSolved) break;
        scale = std::max(kStrict, kStricter * scale);
    }
    return poses;
}

}  // namespace dynamic_filter
