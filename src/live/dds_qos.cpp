// SPDX-License-Identifier: MIT
#include "live/dds_qos.hpp"

#include <fmt/format.h>

#include <array>
#include <vector>

#include "dynamic_filter/error.hpp"
#include "live/dds_log.hpp"

namespace dynamic_filter::live {

namespace {

Qos qos_of(const Quality& quality) {
    Qos qos(dds_create_qos());
    const auto depth = static_cast<std::int32_t>(std::max<std::size_t>(quality.depth, 1));
    dds_qset_reliability(
        qos.get(), quality.reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT, 0);
    dds_qset_durability(qos.get(),
                        quality.latched ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
    dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, depth);
    if (quality.latched) {
        dds_qset_durability_service(qos.get(), 0, DDS_HISTORY_KEEP_LAST, depth, -1, -1, -1);
    }
    dds_qset_ignorelocal(qos.get(), DDS_IGNORELOCAL_PARTICIPANT);
    return qos;
}

std::vector<std::string> reasons_of(dds_return_t code) {
    std::vector<std::string> reasons = pop_dds_log();
    if (reasons.empty()) reasons.emplace_back(dds_strretcode(-code));
    return reasons;
}

}  // namespace

Qos qos_of_writer(const Quality& quality) {
    Qos qos = qos_of(quality);
    constexpr dds_data_representation_id_t kSent = DDS_DATA_REPRESENTATION_XCDR1;
    dds_qset_data_representation(qos.get(), 1, &kSent);
    return qos;
}

Qos qos_of_reader(const Quality& quality) {
    Qos qos = qos_of(quality);
    constexpr std::array<dds_data_representation_id_t, 2> kRead = {DDS_DATA_REPRESENTATION_XCDR1,
                                                                   DDS_DATA_REPRESENTATION_XCDR2};
    dds_qset_data_representation(qos.get(), kRead.size(), kRead.data());
    return qos;
}

Quality quality_of(const dds_qos_t* qos) {
    Quality quality{.reliable = true, .latched = false, .depth = 1};
    dds_reliability_kind_t reliability{};
    dds_duration_t ignored{};
    if (dds_qget_reliability(qos, &reliability, &ignored)) {
        quality.reliable = reliability == DDS_RELIABILITY_RELIABLE;
    }
    dds_durability_kind_t durability{};
    if (dds_qget_durability(qos, &durability)) {
        quality.latched = durability >= DDS_DURABILITY_TRANSIENT_LOCAL;
    }
    return quality;
}

void require(dds_return_t code, const std::string& what) {
    if (code >= 0) return;
    throw Error(fmt::format("{}: {}", what, fmt::join(reasons_of(code), "; ")));
}

}  // namespace dynamic_filter::live
