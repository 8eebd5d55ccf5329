// SPDX-License-Identifier: MIT
#include "filter/keyframes.hpp"

#include <algorithm>
#include <bit>

#include "geometry/thinning.hpp"

namespace dynamic_filter {

namespace {

/// Pixels of thinned scans, whose rings are broken: far away, neighbors are as close as this.
constexpr BeamPattern kFine{.azimuth_spacing = 0.0052F, .elevation_spacing = 0.0087F};

}  // namespace

bool Keyframes::is_reliable(const BeamPattern& beams, const Scan& scan) const {
    return beams.azimuth_spacing > 0.0F && beams.elevation_spacing > 0.0F &&
           scan.points.size() >= static_cast<std::size_t>(config_.least_points);
}

bool Keyframes::add(const Scan& scan, std::uint32_t owner) {
    if (scan.sensor >= sensors_.size()) sensors_.resize(scan.sensor + 1);
    Sensor& sensor = sensors_[scan.sensor];
    if (!choice_.take(scan)) return false;
    const BeamPattern beams = sensor.beams ? *sensor.beams : estimate_beam_pattern({&scan, 1});
    if (!sensor.beams && is_reliable(beams, scan)) {
        sensor.beams = beams;
        sensor.thinned = thinning_of(scan.points);
    }

    const bool looks_far =
        !sensor.last_far_look || scan.stamp - *sensor.last_far_look >= choice_.config().interval;
    if (looks_far) sensor.last_far_look = scan.stamp;
    const float reach =
        looks_far ? farthest_ : std::min(static_cast<float>(config_.near_reach), farthest_);
    kept_.push_back({BeamImage(scan.points, sensor.thinned > 0.0F ? kFine : beams),
                     scan.T_world_sensor.inverse().cast<float>(), reach, scan.index, sensor.thinned,
                     owner});
    ++total_;
    if (kept_.size() > most_ * sensors_.size()) kept_.pop_front();
    return true;
}

void Keyframes::begin_drive() {
    kept_.clear();
    sensors_.clear();
    choice_ = KeyframeChoice(choice_.config());
}

std::vector<Keyframes::Asked> Keyframes::asked_by_new() const {
    std::vector<Asked> asked;
    if (kept_.empty()) return asked;
    // The lower limit avoids a division by zero for an image without beams.
    constexpr float kLeast = 0.01F;
    const float coverage = std::max(kept_.back().image.coverage(), kLeast);
    const auto one_by_one =
        static_cast<std::size_t>(static_cast<float>(config_.images_asked) / coverage);
    for (std::size_t i = 0; i < kept_.size(); ++i) {
        const std::size_t age = kept_.size() - 1 - i;
        const std::size_t apart = std::max<std::size_t>(1, std::bit_floor(age / one_by_one));
        if ((total_ - age) % apart == 0) {
            asked.push_back({&kept_[i], static_cast<unsigned>(apart)});
        }
    }
    return asked;
}

}  // namespace dynamic_filter
