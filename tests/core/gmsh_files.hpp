#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include <octetra/core/files/mesh_files.hpp>

#include "core/refused_files.hpp"

/// Fragments of Gmsh files, which tests combine into valid and invalid files.
namespace octetra::test {

/// The bytes of a binary file, with numbers in this machine's byte order or in the opposite one.
class BinaryBytes {
public:
    explicit BinaryBytes(bool swapped = false) : swapped_(swapped) {}

    BinaryBytes& text(std::string_view text) {
        bytes_ += text;
        return *this;
    }
    BinaryBytes& ints(std::initializer_list<std::int32_t> numbers) { return add(numbers); }
    BinaryBytes& sizes(std::initializer_list<std::uint64_t> numbers) { return add(numbers); }
    BinaryBytes& reals(std::initializer_list<double> numbers) { return add(numbers); }

    [[nodiscard]] const std::string& bytes() const { return bytes_; }
    operator const std::string&() const { return bytes_; }  // NOLINT(google-explicit-constructor)

private:
    template <class T>
    BinaryBytes& add(std::initializer_list<T> numbers) {
        for (const T number : numbers) {
            std::string of_one(sizeof number, '\0');
            std::memcpy(of_one.data(), &number, sizeof number);
            if (swapped_) std::ranges::reverse(of_one);
            bytes_ += of_one;
        }
        return *this;
    }

    bool swapped_;
    std::string bytes_;
};

inline const std::string gmsh_head_2 = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
inline const std::string gmsh_head_4 = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";

/// Four nodes at the corner of a cube.
inline const std::string gmsh_nodes_2 =
    "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n";
inline const std::string gmsh_nodes_4 =
    "$Nodes\n1 4 1 4\n3 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n$EndNodes\n";
/// A cell in group 7.
inline const std::string gmsh_cell_2 = "$Elements\n1\n1 4 2 7 1 1 2 3 4\n$EndElements\n";
inline const std::string gmsh_entities_4 =
    "$Entities\n0 0 0 1\n1 0 0 0 1 1 1 1 7 0\n$EndEntities\n";
inline const std::string gmsh_cell_4 = "$Elements\n1 1 1 1\n3 1 4 1\n1 1 2 3 4\n$EndElements\n";

/// The head of a binary file; every part of it may be wrong.
inline std::string gmsh_binary_head(std::string_view version, bool swapped = false) {
    return BinaryBytes(swapped)
        .text("$MeshFormat\n")
        .text(version)
        .text(" 1 8\n")
        .ints({1})
        .text("\n$EndMeshFormat\n");
}
inline std::string gmsh_binary_4(bool swapped = false) {
    return BinaryBytes(swapped)
        .text(gmsh_binary_head("4.1", swapped))
        .text("$Entities\n")
        .sizes({0, 0, 0, 1})
        .ints({1})
        .reals({0, 0, 0, 1, 1, 1})
        .sizes({1})
        .ints({7})
        .sizes({0})
        .text("\n$EndEntities\n$Nodes\n")
        .sizes({1, 4, 1, 4})
        .ints({3, 1, 0})
        .sizes({4, 1, 2, 3, 4})
        .reals({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1})
        .text("\n$EndNodes\n$Elements\n")
        .sizes({1, 1, 1, 1})
        .ints({3, 1, 4})
        .sizes({1, 1, 1, 2, 3, 4})
        .text("\n$EndElements\n");
}
inline std::string gmsh_binary_2(bool swapped = false) {
    BinaryBytes file(swapped);
    file.text(gmsh_binary_head("2.2", swapped)).text("$Nodes\n4\n");
    file.ints({1}).reals({0, 0, 0}).ints({2}).reals({1, 0, 0});
    file.ints({3}).reals({0, 1, 0}).ints({4}).reals({0, 0, 1});
    file.text("\n$EndNodes\n$Elements\n1\n").ints({4, 1, 2, 1, 7, 1, 1, 2, 3, 4});
    return file.text("\n$EndElements\n");
}

struct GmshRead {
    Mesh mesh;
    std::vector<std::string> notes;
};

/// Reads such a file, by one process and by several.
inline GmshRead read_gmsh(const std::string& content) {
    GmshRead read;
    read.mesh =
        read_content("m.msh", content, {.note = [&](const auto& n) { read.notes.push_back(n); }});
    return read;
}

inline void read_refused_gmsh(const std::string& content) { (void)read_gmsh(content); }

}  // namespace octetra::test
