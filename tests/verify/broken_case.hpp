#pragma once

#include <cstddef>
#include <string>

#include <gtest/gtest.h>

#include <octetra/core/index.hpp>
#include <octetra/verify/verify.hpp>

/// What tables of broken meshes are written with.
namespace octetra::verify {

constexpr VertexIndex vertex(std::size_t i) { return VertexIndex{i}; }
constexpr CellIndex cell(std::size_t i) { return CellIndex{i}; }

/// Of a case with a code that is to be reported, and a word on how the mesh was broken.
template <class Case>
std::string name_of(const testing::TestParamInfo<Case>& info) {
    return std::string(name(info.param.code)) + "_" + info.param.how;
}

}  // namespace octetra::verify
