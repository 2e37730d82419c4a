#include <algorithm>
#include <array>
#include <numbers>

#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/generator/solids.hpp>

#include "circle.hpp"
#include "parameters.hpp"
#include "tetrahedralise.hpp"

namespace octetra::generator {
namespace {

constexpr double root_share = 0.8;            // fraction of the outer radius
constexpr double half_tip = 0.125;            // fraction of a tooth's part of the circle
constexpr double half_base = 0.3;             // likewise
constexpr double half_gap = 0.5 - half_base;  // likewise, between the bases of two teeth

/// Returns the smallest distance of the outline from the axis, in the middle between two teeth.
double inner_distance(const Gear& gear) {
    return root_share * gear.outer_radius *
           direction(half_gap, static_cast<double>(gear.teeth)).cos;
}

void check(const Gear& gear) {
    check_count(gear.teeth, 3, 1000, "the number of teeth");
    check_length(gear.outer_radius, "the outer radius");
    check_length(gear.thickness, "the thickness");
    check_length(gear.bore_radius, "the bore's radius");
    check_length(gear.edge_length, "the edge length");
    const double wall = inner_distance(gear) - gear.bore_radius;
    if (wall <= 0) {
        throw InputError(fmt::format(
            "the bore's radius should be less than {:g}, where this gear's teeth begin, "
            "not {}",
            inner_distance(gear), gear.bore_radius));
    }
    const double tip =
        2 * std::numbers::pi * gear.outer_radius * 2 * half_tip / static_cast<double>(gear.teeth);
    check_cell_estimate(std::numbers::pi * gear.outer_radius * gear.outer_radius * gear.thickness,
                        std::min({gear.edge_length, gear.thickness, gear.bore_radius, wall, tip}));
}

/// Builds the complex of a gear.
class GearBuilder {
public:
    explicit GearBuilder(const Gear& gear) : gear_(&gear) {}

    Complex build() {
        const Polygon low_outline = outline(0);
        const Polygon high_outline = outline(gear_->thickness);
        const Polygon low_bore = bore(0);
        const Polygon high_bore = bore(gear_->thickness);
        add_lid(low_outline, low_bore, 0);
        add_lid(high_outline, high_bore, gear_->thickness);
        add_wall(low_outline, high_outline, 2);
        add_wall(low_bore, high_bore, 3);
        for (const Polygon& ring : {low_outline, high_outline}) add_ridges(ring, 1);
        for (std::size_t k = 0; k < low_outline.size(); ++k) {
            complex_.ridges.push_back({low_outline[k], high_outline[k], 2});
        }
        for (const Polygon& ring : {low_bore, high_bore}) add_ridges(ring, 3);
        return std::move(complex_);
    }

private:
    std::uint32_t add_point(double radius, const Direction& to, double z) {
        return complex_.add({radius * to.cos, radius * to.sin, z});
    }

    Polygon outline(double z) {
        const double outer = gear_->outer_radius;
        const std::array<std::array<double, 2>, 4> tooth{{{-half_base, root_share * outer},
                                                          {-half_tip, outer},
                                                          {half_tip, outer},
                                                          {half_base, root_share * outer}}};
        Polygon ring;
        for (std::uint64_t t = 0; t < gear_->teeth; ++t) {
            for (const auto& [offset, radius] : tooth) {
                const double step = static_cast<double>(t) + offset;
                ring.push_back(
                    add_point(radius, direction(step, static_cast<double>(gear_->teeth)), z));
            }
        }
        return ring;
    }

    Polygon bore(double z) {
        const std::uint32_t sides = circle_parts(gear_->bore_radius, gear_->edge_length, 8);
        Polygon ring;
        for (std::uint32_t s = 0; s < sides; ++s) {
            ring.push_back(add_point(gear_->bore_radius, direction(s, sides), z));
        }
        return ring;
    }

    void add_lid(const Polygon& around, const Polygon& inside, double z) {
        complex_.facets.push_back({.polygons = {around, inside}, .holes = {{0, 0, z}}});
    }

    void add_wall(const Polygon& low, const Polygon& high, Marker marker) {
        for (std::size_t k = 0; k < low.size(); ++k) {
            const std::size_t next = (k + 1) % low.size();
            complex_.facets.push_back(
                {.polygons = {{low[k], low[next], high[next], high[k]}}, .marker = marker});
        }
    }

    void add_ridges(const Polygon& ring, Marker marker) {
        for (std::size_t k = 0; k < ring.size(); ++k) {
            complex_.ridges.push_back({ring[k], ring[(k + 1) % ring.size()], marker});
        }
    }

    const Gear* gear_;
    Complex complex_;
};

}  // namespace

Mesh gear(const Gear& gear) {
    check(gear);
    return fill(GearBuilder(gear).build(), gear.edge_length, Surface::may_be_cut);
}

}  // namespace octetra::generator
