#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace octetra {

/// The name that a mesh file assigns to the entities of a dimension with a tag: a physical group in
/// Gmsh.
struct GroupName {
    std::int32_t dimension = 0;  ///< 0 vertices, 1 edges, 2 facets, 3 cells
    std::int32_t tag = 0;        ///< a region tag or marker
    std::string
        name;  ///< UTF-8, without control characters; not empty. Reserved: "octetra:untagged"

    friend bool operator==(const GroupName&, const GroupName&) = default;
};

/// Group names shared by several meshes. Copying allocates no memory, so no process can fail in the
/// middle of a collective step.
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
