#include "plex_labels.hpp"

#include <algorithm>
#include <utility>

#include <petscis.h>

#include "check_petsc.hpp"

namespace octetra::petsc {
namespace {

/// Owns a reference to an IS.
class IndexSet {
public:
    explicit IndexSet(IS set) : set_(set) {
        if (set_ != nullptr) {
            check(ISGetIndices(set_, &indices_));
            check(ISGetLocalSize(set_, &size_));
        }
    }
    ~IndexSet() {
        if (set_ != nullptr) {
            (void)ISRestoreIndices(set_, &indices_);
            (void)ISDestroy(&set_);
        }
    }
    IndexSet(const IndexSet&) = delete;
    IndexSet& operator=(const IndexSet&) = delete;
    IndexSet(IndexSet&&) = delete;
    IndexSet& operator=(IndexSet&&) = delete;

    [[nodiscard]] std::span<const PetscInt> indices() const {
        return {indices_, static_cast<std::size_t>(size_)};
    }

private:
    IS set_ = nullptr;
    const PetscInt* indices_ = nullptr;
    PetscInt size_ = 0;
};

/// Returns the distinct markers.
std::vector<Marker> markers_in(std::span<const MarkedPoint> points) {
    std::vector<Marker> markers;
    for (const MarkedPoint& one : points) {
        if (markers.empty() || markers.back() != one.marker) markers.push_back(one.marker);
    }
    std::ranges::sort(markers);
    const auto repeated = std::ranges::unique(markers);
    markers.erase(repeated.begin(), repeated.end());
    return markers;
}

}  // namespace

void set_label(DM plex, const std::string& name, std::span<const MarkedPoint> points) {
    check(DMCreateLabel(plex, name.c_str()));
    DMLabel label = nullptr;
    check(DMGetLabel(plex, name.c_str(), &label));
    // Create one set of points for each marker: inserting single points takes several times as
    // long.
    const std::vector<Marker> markers = markers_in(points);
    std::vector<std::vector<PetscInt>> strata(markers.size());
    for (const MarkedPoint& one : points) {
        const auto found = std::ranges::lower_bound(markers, one.marker);
        strata[static_cast<std::size_t>(found - markers.begin())].push_back(one.point);
    }
    for (std::size_t k = 0; k < markers.size(); ++k) {
        IS stratum = nullptr;
        check(ISCreateGeneral(PETSC_COMM_SELF, static_cast<PetscInt>(strata[k].size()),
                              strata[k].data(), PETSC_COPY_VALUES, &stratum));
        const PetscErrorCode outcome = DMLabelSetStratumIS(label, markers[k], stratum);
        (void)ISDestroy(&stratum);
        check(outcome);
    }
}

std::vector<MarkedPoint> points_of_label(DM plex, const std::string& name, PetscInt begin,
                                         PetscInt end) {
    DMLabel label = nullptr;
    check(DMGetLabel(plex, name.c_str(), &label));
    std::vector<MarkedPoint> found;
    if (label == nullptr) return found;
    IS set = nullptr;
    check(DMLabelGetValueIS(label, &set));
    const IndexSet values(set);
    for (const PetscInt value : values.indices()) {
        check(DMLabelGetStratumIS(label, value, &set));
        const IndexSet stratum(set);
        for (const PetscInt point : stratum.indices()) {
            if (point >= begin && point < end) {
                found.push_back({point, static_cast<Marker>(value)});
            }
        }
    }
    return found;
}

}  // namespace octetra::petsc
