#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <unordered_map>
#include <vector>

#include <octetra/core/point.hpp>

#include "shapes/cell_certifier.hpp"
#include "shapes/root_shape.hpp"

namespace octetra::verify::shapes {

/// The certificates of cells; those of equal shape are computed once.
class Certificates {
public:
    explicit Certificates(std::size_t limit) : certifier_(limit) {}

    /// Throws CellCertifier::TooThin. Precondition: the cell is positively oriented.
    const CellCertificate& of(const std::array<Point, 4>& corners) {
        const RootShape root = root_shape(corners);
        const auto [found, is_new] = numbers_.try_emplace(bytes_of(root), list_.size());
        if (is_new) list_.push_back(certifier_.certify(root));
        return list_[found->second];
    }

private:
    CellCertifier certifier_;
    std::unordered_map<std::string, std::size_t> numbers_;
    std::vector<CellCertificate> list_;
};

}  // namespace octetra::verify::shapes
