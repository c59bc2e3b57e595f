// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The library as others take it: installed, as a subproject, and from Python.
#include <gtest/gtest.h>

#include <fstream>

#include "support/program.h"
#include "support/sanitizer.h"
#include "support/temporary_directory.h"
#include "test_paths.h"

namespace ltc::test {
namespace {

namespace fs = std::filesystem;

void expect_success(const ProgramResult& result) {
  ASSERT_EQ(result.exit_code, 0) << result.out << result.err;
}

class Installed : public ::testing::Test {
 protected:
  void SetUp() override {
    if (under_sanitizer)
      GTEST_SKIP() << "a library with a sanitizer is for programs with the same";
  }
  const TemporaryDirectory folder;
};

TEST_F(Installed, AProgramOutsideTheProjectBuildsAndRuns) {
  expect_success(run_program(
      {"cmake", "--install", LTCFIT_BINARY_DIR, "--prefix", (folder / "tree").string()}));
  expect_success(run_program({"cmake", "-S", LTCFIT_SOURCE_DIR "/examples/library", "-B",
                              (folder / "build").string(),
                              "-DCMAKE_PREFIX_PATH=" + (folder / "tree").string()}));
  expect_success(run_program({"cmake", "--build", (folder / "build").string()}));
  const ProgramResult result =
      run_program({(folder / "build/ltcfit_example").string()}, folder.path());
  expect_success(result);
  EXPECT_NE(result.out.find("looked up: amplitude 0."), std::string::npos) << result.out;
  EXPECT_TRUE(fs::exists(folder / "example.h5"));
  expect_success(run_program({(folder / "tree/bin/ltcfit").string(), "--version"}));
}

// The installed headers include nothing but Eigen, the standard library and one another.
TEST_F(Installed, ThePublicHeadersNeedEigenAlone) {
  for (const fs::directory_entry& header :
       fs::directory_iterator(LTCFIT_SOURCE_DIR "/include/ltcfit")) {
    std::ifstream lines(header.path());
    for (std::string line; std::getline(lines, line);)
      if (line.starts_with("#include")) {
        EXPECT_TRUE(line.starts_with("#include <Eigen/") ||
                    line.starts_with("#include \"ltcfit/") ||
                    (line.starts_with("#include <") && line.find_first_of("./") == line.npos))
            << header.path() << ": " << line;
      }
  }
}

TEST(Subproject, BuildsNoTestsAndKeepsItsNamesToItself) {
  const TemporaryDirectory folder;
  folder.write("CMakeLists.txt", R"(cmake_minimum_required(VERSION 3.25)
project(outside LANGUAGES CXX C)
add_subdirectory()" LTCFIT_SOURCE_DIR R"( ltcfit)
get_property(targets DIRECTORY )" LTCFIT_SOURCE_DIR R"( PROPERTY BUILDSYSTEM_TARGETS)
message(STATUS "targets: ${targets}; build type: '${CMAKE_BUILD_TYPE}'")
if(NOT TARGET ltcfit::ltcfit)
  message(FATAL_ERROR "no target ltcfit::ltcfit")
endif()
foreach(target IN LISTS targets)
  if(NOT target MATCHES "^ltcfit")
    message(FATAL_ERROR "target ${target} has a name that could be another's")
  endif()
endforeach()
)");
  const ProgramResult result = run_program({"cmake", "-S", folder.path().string(), "-B",
                                            (folder / "build").string(), "-DGTest_DIR=/nowhere"});
  expect_success(result);
  EXPECT_EQ(result.out.find("ltcfit_tests"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("build type: ''"), std::string::npos) << result.out;
}

// The system's Python, whose headers the module was built with.
ProgramResult run_python(const std::string& script) {
  return run_program({"env", "PYTHONPATH=" LTCFIT_BINARY_DIR "/python", "/usr/bin/python3",
                      LTCFIT_SOURCE_DIR "/" + script});
}

class Python : public Installed {};

TEST_F(Python, TheModuleGivesWhatTheLibraryGives) {
  expect_success(run_python("tests/library/check_module.py"));
}

TEST_F(Python, TheExampleRuns) {
  const ProgramResult result = run_python("examples/python/fit_and_look_up.py");
  expect_success(result);
  EXPECT_NE(result.out.find("(1 - F0)"), std::string::npos) << result.out;
}

}  // namespace
}  // namespace ltc::test
