#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace octetra {

/// What a mesh file calls the entities of a dimension that have this tag: a physical group of Gmsh.
struct GroupName {
    std::int32_t dimension = 0;  ///< 0 vertices, 1 edges, 2 facets, 3 cells
    std::int32_t tag = 0;        ///< a region tag or marker
    std::string
        name;  ///< UTF-8, without control characters; not empty. Reserved: "octetra:untagged"

    friend bool operator==(const GroupName&, const GroupName&) = default;
};

/// Names that several meshes have in common. Copies take no memory, so that no process can fail in
/// the midst of a step of all.
class SharedGroupNames {
public:
    SharedGroupNames() = default;
    explicit SharedGroupNames(std::vector<GroupName> names) {
        if (names.empty()) return;
        names_ = std::make_shared<const std::vector<GroupName>>(std::move(names));
    }

    [[nodiscard]] bool empty() const { return names_ == nullptr; }
    [[nodiscard]] const std::vector<GroupName>& list() const {
        static const std::vector<GroupName> none;
        return empty() ? none : *names_;
    }

private:
    std::shared_ptr<const std::vector<GroupName>> names_;
};

}  // namespace octetra
