#include "parts/cut_space.hpp"

#include <array>
#include <span>

#include "parts/exchange.hpp"

namespace octetra::verify {
namespace {

using Coordinates = std::array<double, 3>;

/// The maximum number of points sampled on each process.
constexpr std::size_t most_samples = 4096;

std::vector<Coordinates> samples_of_all(const std::vector<Point>& places,
                                        const ProcessGroup& group) {
    std::vector<Coordinates> samples;
    const std::size_t stride = places.size() / most_samples + 1;
    for (std::size_t i = 0; i < places.size(); i += stride) {
        samples.push_back({places[i].x, places[i].y, places[i].z});
    }
    std::vector<Coordinates> all;
    for (const auto& of_one : share_with_all(group, samples)) {
        all.insert(all.end(), of_one.begin(), of_one.end());
    }
    return all;
}

std::size_t longest_side(std::span<const Coordinates> places) {
    Bounds bounds;
    for (const Coordinates& p : places) bounds.take(Point{p[0], p[1], p[2]});
    std::size_t axis = 0;
    // Halved first, since the difference could overflow.
    const auto side = [&](std::size_t k) { return bounds.high[k] / 2 - bounds.low[k] / 2; };
    for (std::size_t k = 1; k < 3; ++k) axis = side(k) > side(axis) ? k : axis;
    return axis;
}

/// Divides `whole` between the processes of `domains` by recursive bisection, in proportion to the
/// points.
void cut(const Domain& whole, std::span<Coordinates> places, std::span<Domain> domains) {
    if (domains.size() == 1) {
        domains.front() = whole;
        return;
    }
    Domain low = whole;
    Domain high = whole;
    const std::size_t lower_domains = domains.size() / 2;
    std::size_t lower_places = 0;
    const std::size_t axis = longest_side(places);
    if (!places.empty()) {
        lower_places = places.size() * lower_domains / domains.size();
        const auto middle = places.begin() + static_cast<std::ptrdiff_t>(lower_places);
        std::nth_element(
            places.begin(), middle, places.end(),
            [&](const Coordinates& p, const Coordinates& q) { return p[axis] < q[axis]; });
        low.high[axis] = high.low[axis] = (*middle)[axis];
    } else {
        low.high[axis] = high.low[axis] = whole.low[axis];  // the lower part is empty
    }
    cut(low, places.first(lower_places), domains.first(lower_domains));
    cut(high, places.subspan(lower_places), domains.subspan(lower_domains));
}

}  // namespace

std::vector<Domain> cut_space(const std::vector<Point>& places, const ProcessGroup& group) {
    std::vector<Domain> domains(static_cast<std::size_t>(group.size()));
    if (group.size() == 1) return domains;
    Domain everything;
    everything.is_everything = false;
    std::vector<Coordinates> samples = samples_of_all(places, group);
    cut(everything, samples, domains);
    return domains;
}

Bounds closed_box(const Domain& domain, const Bounds& bounds) {
    Bounds box;
    for (std::size_t k = 0; k < 3; ++k) {
        if (domain.low[k] >= domain.high[k]) return {};
        box.low[k] = std::max(domain.low[k], bounds.low[k]);
        box.high[k] = std::min(domain.high[k], bounds.high[k]);
        if (!(box.low[k] <= box.high[k])) return {};
    }
    return box;
}

}  // namespace octetra::verify
