#include "files/gmsh/element_types.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace octetra::gmsh {
namespace {

struct NumberedType {
    std::uint64_t number;
    ElementType type;
};

constexpr ElementType line(std::uint32_t nodes) { return {Shape::line, nodes}; }
constexpr ElementType triangle(std::uint32_t nodes) { return {Shape::triangle, nodes}; }
constexpr ElementType quadrangle(std::uint32_t nodes) { return {Shape::quadrangle, nodes}; }
constexpr ElementType tetrahedron(std::uint32_t nodes) { return {Shape::tetrahedron, nodes}; }
constexpr ElementType hexahedron(std::uint32_t nodes) { return {Shape::hexahedron, nodes}; }
constexpr ElementType prism(std::uint32_t nodes) { return {Shape::prism, nodes}; }
constexpr ElementType pyramid(std::uint32_t nodes) { return {Shape::pyramid, nodes}; }

constexpr std::array<NumberedType, 68> types{{
    {1, line(2)},           {2, triangle(3)},       {3, quadrangle(4)},      {4, tetrahedron(4)},
    {5, hexahedron(8)},     {6, prism(6)},          {7, pyramid(5)},         {8, line(3)},
    {9, triangle(6)},       {10, quadrangle(9)},    {11, tetrahedron(10)},   {12, hexahedron(27)},
    {13, prism(18)},        {14, pyramid(14)},      {15, {Shape::point, 1}}, {16, quadrangle(8)},
    {17, hexahedron(20)},   {18, prism(15)},        {19, pyramid(13)},       {20, triangle(9)},
    {21, triangle(10)},     {22, triangle(12)},     {23, triangle(15)},      {24, triangle(15)},
    {25, triangle(21)},     {26, line(4)},          {27, line(5)},           {28, line(6)},
    {29, tetrahedron(20)},  {30, tetrahedron(35)},  {31, tetrahedron(56)},   {32, tetrahedron(22)},
    {33, tetrahedron(28)},  {36, quadrangle(16)},   {37, quadrangle(25)},    {38, quadrangle(36)},
    {39, quadrangle(12)},   {40, quadrangle(16)},   {41, quadrangle(20)},    {42, triangle(28)},
    {43, triangle(36)},     {44, triangle(45)},     {45, triangle(55)},      {46, triangle(66)},
    {47, quadrangle(49)},   {48, quadrangle(64)},   {49, quadrangle(81)},    {50, quadrangle(100)},
    {51, quadrangle(121)},  {62, line(7)},          {63, line(8)},           {64, line(9)},
    {65, line(10)},         {66, line(11)},         {71, tetrahedron(84)},   {72, tetrahedron(120)},
    {73, tetrahedron(165)}, {74, tetrahedron(220)}, {75, tetrahedron(286)},  {90, prism(40)},
    {91, prism(75)},        {92, hexahedron(64)},   {93, hexahedron(125)},   {94, hexahedron(216)},
    {95, hexahedron(343)},  {96, hexahedron(512)},  {97, hexahedron(729)},   {98, hexahedron(1000)},
}};

}  // namespace

std::optional<ElementType> element_type(std::uint64_t number) {
    const auto found = std::ranges::find(types, number, &NumberedType::number);
    if (found == types.end()) return std::nullopt;
    return found->type;
}

std::string_view plural(Shape shape) {
    switch (shape) {
        case Shape::point: return "points";
        case Shape::line: return "lines";
        case Shape::triangle: return "triangles";
        case Shape::quadrangle: return "quadrangles";
        case Shape::tetrahedron: return "tetrahedra";
        case Shape::hexahedron: return "hexahedra";
        case Shape::prism: return "prisms";
        case Shape::pyramid: return "pyramids";
    }
    return "elements";
}

std::string refusal_of_type(std::uint64_t number) {
    const auto type = element_type(number);
    if (!type) return fmt::format("elements of type {} are not known", number);
    if (type->shape == Shape::tetrahedron && number != tetrahedron_type) {
        return fmt::format(
            "only tetrahedra of 4 nodes are supported, and these have {}: mesh again with "
            "gmsh -3 -order 1, or have a script of Gmsh do Merge, SetOrder 1 and Save",
            type->nodes);
    }
    if (is_solid(type->shape) && number != tetrahedron_type) {
        return fmt::format("only tetrahedral meshes are supported, and this one has {}",
                           plural(type->shape));
    }
    return {};
}

}  // namespace octetra::gmsh
