#pragma once

#include <memory>
#include <string>
#include <utility>

namespace octetra::distributed {

class BackgroundCells;

/// A field on a mesh of its own, the background mesh, for background(NAME) of expressions: for
/// example sizes that are given on another mesh than the one to be refined. See
/// AdaptiveMesh::as_background().
class Background {
public:
    Background(std::string name, std::shared_ptr<const BackgroundCells> cells)
        : name_(std::move(name)), cells_(std::move(cells)) {}

    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] const BackgroundCells& cells() const { return *cells_; }

private:
    std::string name_;
    std::shared_ptr<const BackgroundCells> cells_;
};

}  // namespace octetra::distributed
