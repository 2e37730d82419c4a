#include <cctype>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <octetra/core/files/mesh_files.hpp>

#include "cli/octetra_program.hpp"

/// Values of options, and the message about wrong ones: one line with the option, the value and
/// what is expected.
namespace octetra {
namespace {

using test::TemporaryFolder;
using testing::HasSubstr;

class Usage : public testing::Test {
protected:
    Usage() {
        EXPECT_EQ(test::octetra("generate two-material -o m.ele --quiet", folder).status, 0);
    }

    /// The last argument may be any text, including blanks and line ends.
    [[nodiscard]] test::Outcome run(const std::string& arguments, const std::string& last) const {
        auto command = test::words(OCTETRA_PROGRAM " " + arguments);
        command.push_back(last);
        return test::run_program(command, folder.path());
    }

    void expect_refused(const std::string& arguments, const std::string& value,
                        const std::string& message) const {
        const test::Outcome outcome = run(arguments, value);
        EXPECT_EQ(outcome.status, 2) << arguments << " " << value;
        EXPECT_EQ(outcome.err, "octetra: " + message + "\n") << arguments << " " << value;
        EXPECT_EQ(outcome.out, "") << arguments << " " << value;
        EXPECT_FALSE(std::filesystem::exists(folder / "out.mesh")) << arguments << " " << value;
    }

    const TemporaryFolder folder;
};

struct NumberOption {
    std::string arguments;
    std::string name;
    std::string takes;
    bool whole = true;
};

const std::vector<NumberOption> number_options{
    {"refine m.ele -o out.mesh --all --levels", "--levels", "a whole number from 0 to 50"},
    {"verify m.ele m.ele --all --levels", "--levels", "a whole number from 0 to 50"},
    {"refine m.ele -o out.mesh --all --max-cells", "--max-cells", "a whole number from 1 up"},
    {"adapt m.ele -o out.mesh --script s.txt --max-cells", "--max-cells",
     "a whole number from 1 up"},
    {"refine m.ele -o out.mesh --random 1 --seed", "--seed", "a whole number from 0 up"},
    {"refine m.ele -o out.mesh --region", "--region",
     "a whole number from -2147483648 to 2147483647"},
    {"partition m.ele -n 2 --region", "--region", "a whole number from -2147483648 to 2147483647"},
    {"partition m.ele -n", "--parts", "a whole number from 1 to 1000000"},
    {"generate gear -o out.mesh --teeth", "--teeth", "a whole number from 0 up"},
    {"generate random 9 -o out.mesh --seed", "--seed", "a whole number from 0 up"},
    {"generate kuhn -o out.mesh", "N", "a whole number from 1 up"},
    {"generate bcc -o out.mesh", "N", "a whole number from 1 up"},
    {"refine m.ele -o out.mesh --random", "--random", "a number from 0 to 1", false},
    {"refine m.ele -o out.mesh --max-volume", "--max-volume", "a number from 0 up", false},
    {"verify m.ele --min-dihedral", "--min-dihedral", "a number from 0 to 180", false},
    {"generate sphere -o out.mesh --edge", "--edge", "a number from 1e-30 to 1e30", false},
    {"generate bcc 1 -o out.mesh --size", "--size", "a number from 1e-30 to 1e30", false},
};

TEST_F(Usage, OfNumbersIsReportedInOneLine) {
    std::size_t combination = 0;
    for (const auto& [arguments, name, takes, whole] : number_options) {
        std::vector<std::string> values{"",   "x",  "nan", "inf", "0x2",  "2q",
                                        " 2", "2 ", "+-2", "2,2", "1e400"};
        if (whole) values.insert(values.end(), {"1.5", "2.0", "1e0", "1e-310"});
        for (const std::string& value : values) {
            // Every fourth combination covers each of about 15 values and as many options.
            if (combination++ % 4 != 0) continue;
            if (name == "--region" && std::isalpha(static_cast<unsigned char>(value[0])) != 0) {
                expect_refused(arguments, value,
                               "--region: no group of cells of this mesh has a name, and '" +
                                   value + "' is no tag");
                continue;
            }
            const bool too_large = !whole && value == "1e400";
            expect_refused(arguments, value,
                           name + " takes " + takes + ", not '" + value + "'" +
                               (too_large ? "; it is out of range" : ""));
        }
    }
}

TEST_F(Usage, OfNumbersThatUnderflowIsReported) {
    for (const auto& [arguments, name, takes, whole] : number_options) {
        if (whole) continue;
        for (const std::string value : {"1e-400", "-1e-400", "2e-324"}) {
            expect_refused(arguments, value,
                           name + " takes " + takes + ", not '" + value + "'; it is out of range");
        }
    }
    for (const std::string value : {"1e-310", "5e-324"}) {
        expect_refused(
            "refine m.ele -o out.mesh --random", value,
            "--random takes a number from 0 to 1, not '" + value + "'; it is out of range");
    }
    for (const std::string option :
         {"--sphere 0,0,0,", "--sphere 0,1e-400,0,", "--box 1e-400,0,0,1,1,"}) {
        const auto outcome = run("refine m.ele -o out.mesh " + option + "1e-400", "--quiet");
        EXPECT_EQ(outcome.status, 2) << option;
        EXPECT_THAT(outcome.err, HasSubstr(" finite numbers as ")) << option;
    }
}

TEST_F(Usage, OfNumbersOutOfRangeIsReported) {
    expect_refused("refine m.ele -o out.mesh --all --levels", "51",
                   "--levels takes a whole number from 0 to 50, not '51'");
    expect_refused("refine m.ele -o out.mesh --all --levels", "99999999999999999999",
                   "--levels takes a whole number from 0 to 50, not '99999999999999999999'; it is "
                   "out of range");
    expect_refused("refine m.ele -o out.mesh --region", "2147483648",
                   "--region takes a whole number from -2147483648 to 2147483647, not "
                   "'2147483648'; it is out of range");
    expect_refused("refine m.ele -o out.mesh --random", "1.5",
                   "--random takes a number from 0 to 1, not '1.5'");
    expect_refused("refine m.ele -o out.mesh --max-volume", "-1e-310",
                   "--max-volume takes a number from 0 up, not '-1e-310'");
    expect_refused("generate sphere -o out.mesh --edge", "1e-310",
                   "--edge takes a number from 1e-30 to 1e30, not '1e-310'");
}

/// A sign and leading zeros: the number is still decimal.
TEST_F(Usage, OfNumbersIsThatOfDecimals) {
    const auto cells_after = [&](const std::string& options) {
        const auto outcome = run("refine m.ele -o out.mesh --quiet " + options, "--all");
        EXPECT_EQ(outcome.status, 0) << options << outcome.err;
        return read_mesh(folder / "out.mesh").cells.size();
    };
    const std::size_t once = cells_after("--levels 1");
    for (const std::string levels : {"+1", "01", "0001"}) {
        EXPECT_EQ(cells_after("--levels " + levels), once) << levels;
    }
    std::filesystem::remove(folder / "out.mesh");
    expect_refused("refine m.ele -o out.mesh --quiet --all --max-cells 010 --levels", "1",
                   "m.ele: level 1 would make " + std::to_string(once) +
                       " cells, more than the 10 allowed: mark fewer cells or levels, or allow "
                       "more");
    for (const std::string options : {"--max-volume +.5", "--max-volume 1e-310", "--random 1.",
                                      "--region -2147483648", "--max-volume 5E+3"}) {
        EXPECT_EQ(run("refine m.ele -o free.mesh --quiet " + options, "--levels=1").status, 0)
            << options;
    }
}

TEST_F(Usage, OfNamesAndWordsIsReportedInOneLine) {
    const std::string refine = "refine m.ele --all -o out.mesh ";
    for (const std::string option : {"--maps", "--profile", "--trace", "--cells"}) {
        expect_refused(refine + option, "",
                       option + ": '' is not a file name; see octetra refine --help");
    }
    expect_refused("refine m.ele --all -o", "",
                   "--output: '' is not a file name; see octetra refine --help");
    expect_refused("info", "", "MESH: '' is not a file name; see octetra info --help");
    expect_refused("convert m.ele", "", "OUT: '' is not a file name; see octetra convert --help");
    expect_refused("compare m.ele", "", "B: '' is not a file name; see octetra compare --help");
    expect_refused("verify m.ele", "", "REFINED: '' is not a file name; see octetra verify --help");
    expect_refused("verify m.ele --report", "",
                   "--report: '' is not a file name; see octetra verify --help");
    expect_refused("partition m.ele -n 2 -o", "",
                   "--output: '' is not a file name; see octetra partition --help");
    expect_refused(refine + "--scheme", "", "--scheme takes one of 8t, 4t, 2t, not ''");
    expect_refused(refine + "--engine", "x",
                   "--engine takes one of distributed, reference, not 'x'");
    expect_refused(refine + "--sync", "x", "--sync takes one of neighbour, gateway, not 'x'");
    for (const std::string word : {"x", "often", "1,5", "1e99", "-1", "nan"}) {
        expect_refused(
            refine + "--rebalance", word,
            "--rebalance takes auto, never or a number from 0 to 1e9, not '" + word + "'");
    }
    for (const std::string value : {"", "x", "random:", "random:x", "random:1.5", "file:"}) {
        expect_refused(refine + "--partition", value,
                       "--partition takes lepp, dual, rcb, block, random:SEED or file:PATH, not '" +
                           value + "'");
    }
}

TEST_F(Usage, OfTooFewAndTooManyValuesIsReportedInOneLine) {
    const std::string refine = "refine m.ele -o out.mesh ";
    expect_refused(refine, "--levels",
                   "--levels requires a value, L:0 to 50; see octetra refine --help");
    expect_refused(refine, "--maps", "--maps requires a value, FILE; see octetra refine --help");
    expect_refused(refine + "--all --levels 1", "--levels=2",
                   "--levels takes no more than 1 value, not 2; see octetra refine --help");
    expect_refused(refine, "--all=3", "--all takes no value; see octetra refine --help");
    expect_refused(refine, "--quiet=x", "--quiet takes no value; see octetra refine --help");
    expect_refused("generate kuhn 1 2 3 -o out.mesh", "4",
                   "N takes no more than 3 values, not 4; see octetra generate kuhn --help");
    expect_refused("refine", "m.ele", "-o, --output is required; see octetra refine --help");
    expect_refused("partition", "m.ele", "-n, --parts is required; see octetra partition --help");
    expect_refused("refine m.ele --all", "-o=x.mesh",
                   "--output: '=x.mesh' begins with =; leave it out, or write ./=x.mesh; see "
                   "octetra refine --help");
    expect_refused("refine m.ele --all --profile", "-o",
                   "--profile requires a value, FILE: -o is an option; see octetra refine --help");
    expect_refused("adapt m.ele --script", "--output=a.ele",
                   "--script requires a value, FILE: --output is an option; see octetra adapt "
                   "--help");
    expect_refused("generate kuhn 2", "--sise",
                   "kuhn has no option --sise; did you mean --size? See octetra generate kuhn "
                   "--help");
}

TEST_F(Usage, IsReportedInOneLineForAnyCharactersInAName) {
    EXPECT_EQ(run("info", "m\n\x1b.ele").err,
              "octetra: m\\x0a\\x1b.ele: cannot be opened: No such file or directory\n");
}

}  // namespace
}  // namespace octetra
