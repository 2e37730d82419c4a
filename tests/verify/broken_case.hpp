#pragma once

#include <cstddef>
#include <string>

#include <gtest/gtest.h>

#include <octetra/core/index.hpp>
#include <octetra/verify/verify.hpp>

/// Helpers of the tables of broken meshes.
namespace octetra::verify {

constexpr VertexIndex vertex(std::size_t i) { return VertexIndex{i}; }
constexpr CellIndex cell(std::size_t i) { return CellIndex{i}; }

/// The name of a case from its expected code and a word about the fault.
template <class Case>
std::string name_of(const testing::TestParamInfo<Case>& info) {
    return std::string(name(info.param.code)) + "_" + info.param.how;
}

}  // namespace octetra::verify
