#include "info/print_statistics.hpp"

#include <algorithm>
#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace octetra::cli {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

quality::MeshStatistics sample() {
    quality::MeshStatistics s;
    s.counts = {.vertices = 1'234'567,
                .edges = 8'000'000,
                .faces = 13'000'000,
                .cells = 6'000'000,
                .boundary_faces = 1'000,
                .components = 1,
                .euler_characteristic = -3};
    s.bounding_box = Box{{0, -0.0, -1}, {1, 2, 1.0 / 3}};
    s.volume = 1.0 / 3;
    s.dihedral_angle = quality::Range{10.123456789, 170};
    s.dihedral_histogram.counts[1] = 1;
    s.dihedral_histogram.counts[9] = 3'999'999'999;
    s.eta = quality::Quality{0.25, 0.75, 1};
    s.adjacency = quality::Adjacency{4.5, 20, 12, 4, 6, 24};
    return s;
}

std::size_t longest_line(const std::string& text) {
    std::size_t longest = 0;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) longest = std::max(longest, line.size());
    return longest;
}

TEST(Table, FitsIn80ColumnsWithoutBlanksAtLineEnds) {
    const std::string table = format_table(sample());
    EXPECT_LE(longest_line(table), 80);
    EXPECT_THAT(table, Not(HasSubstr(" \n")));
}

TEST(Table, GroupsThousandsAndShowsSixDigits) {
    const std::string table = format_table(sample());
    EXPECT_THAT(table, HasSubstr(" 1,234,567\n"));
    EXPECT_THAT(table, HasSubstr(" 0.333333\n"));
    EXPECT_THAT(table, HasSubstr(" 10.1235 "));
    EXPECT_THAT(table, Not(HasSubstr(" -0 ")));
}

TEST(Table, DrawsABarForEvenOneOfBillions) {
    const std::string table = format_table(sample());
    EXPECT_THAT(table, HasSubstr("0.00 %  #\n"));
    EXPECT_THAT(table, HasSubstr("100.00 %  ################\n"));
}

TEST(Table, OfAMeshWithoutCellsShowsNone) {
    const std::string table = format_table(quality::measure(Mesh{}));
    EXPECT_THAT(table, HasSubstr("none"));
    EXPECT_THAT(table, Not(HasSubstr("nan")));
    EXPECT_THAT(table, Not(HasSubstr("inf")));
}

TEST(Table, ShowsTheFirstTwentyTagsOfMany) {
    quality::MeshStatistics s = sample();
    for (Marker tag = 100; tag < 1150; ++tag) s.regions.push_back({tag, 1, 1});
    const std::string table = format_table(s);
    EXPECT_THAT(table, HasSubstr("\n  119 "));
    EXPECT_THAT(table, Not(HasSubstr("\n  120 ")));
    EXPECT_THAT(table, HasSubstr("and 1,030 more"));
}

TEST(Json, KeepsEveryBitOfANumber) {
    const json out = json::parse(format_json(sample()));
    EXPECT_EQ(out["volume"].get<double>(), 1.0 / 3);
    EXPECT_EQ(out["dihedral_angle"]["min"].get<double>(), 10.123456789);
    EXPECT_EQ(out["bounding_box"]["high"][2].get<double>(), 1.0 / 3);
    EXPECT_EQ(out["counts"]["euler_characteristic"].get<int>(), -3);
    EXPECT_EQ(out["adjacency"]["max_cells_at_vertex"].get<int>(), 24);
}

TEST(Json, HasTheNamesThatTheHeaderPromises) {
    const json out = json::parse(format_json(sample()));
    for (const char* name :
         {"counts", "bounding_box", "volume", "boundary_area", "regions", "facet_markers",
          "edge_markers", "features", "edge_length", "cell_volume", "face_angle", "dihedral_angle",
          "eta", "dihedral_histogram", "eta_histogram", "adjacency"}) {
        EXPECT_TRUE(out.contains(name)) << name;
    }
    EXPECT_EQ(out.size(), 16);
    EXPECT_EQ(out["counts"].size(), 11);
    EXPECT_EQ(out["adjacency"].size(), 6);
}

TEST(Json, ListsEveryTag) {
    quality::MeshStatistics s = sample();
    for (Marker tag = 0; tag < 30; ++tag) s.regions.push_back({tag, 2, 0.5});
    s.facet_markers = {{-1, 7, 0.25}};
    const json out = json::parse(format_json(s));
    EXPECT_EQ(out["regions"].size(), 30);
    EXPECT_EQ(out["regions"][29], (json{{"tag", 29}, {"cells", 2}, {"volume", 0.5}}));
    EXPECT_EQ(out["facet_markers"][0], (json{{"marker", -1}, {"facets", 7}, {"area", 0.25}}));
}

TEST(Json, OfAMeshWithoutCellsHasNullsNotZeros) {
    const json out = json::parse(format_json(quality::measure(Mesh{})));
    for (const char* name : {"bounding_box", "edge_length", "cell_volume", "face_angle",
                             "dihedral_angle", "eta", "adjacency"}) {
        EXPECT_TRUE(out[name].is_null()) << name;
    }
    EXPECT_EQ(out["regions"], json::array());
    EXPECT_EQ(out["volume"], 0);
}

}  // namespace
}  // namespace octetra::cli
