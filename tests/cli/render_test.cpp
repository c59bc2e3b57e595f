// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// ltcfit render as a user runs it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "export/table_file.h"
#include "render/png_writer.h"
#include "support/program.h"
#include "support/refusal.h"
#include "table/synthetic.h"

namespace ltc::test {
namespace {

class Render : public ::testing::Test {
 protected:
  Render() {
    write_table(testing::synthetic_table(Grid::paper(3), Storage::mirror_frame), folder_ / "t.h5");
    write_table(testing::synthetic_table(Grid::paper(2), Storage::matrix), folder_ / "t.npy");
  }

  // Small and coarse, in the test's folder.
  ProgramResult run(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"render"});
    arguments.insert(arguments.end(), {"--size", "8", "--samples", "16"});
    return run_ltcfit(arguments, folder_.path());
  }

  TemporaryDirectory folder_;
};

TEST_F(Render, WritesAPictureAndTheImagesOfFourMaterials) {
  const ProgramResult result = run({"t.h5", "-o", "spheres"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const std::vector<std::string> expected{"spheres.png", "spheres_0.05_0.25.exr",
                                          "spheres_0.5_0.02.exr", "spheres_0.5_0.25.exr",
                                          "spheres_0.5_1.exr"};
  EXPECT_EQ(names_in(folder_ / "spheres"), expected);
  EXPECT_EQ(read_file(folder_ / "spheres/spheres.png").substr(1, 3), "PNG");
  for (const std::string& name : expected)
    EXPECT_NE(result.out.find(name), std::string::npos) << name;
  for (const char* part : {"mean |error|", "RMSE", "noise", "seconds"})
    EXPECT_NE(result.out.find(part), std::string::npos) << part;
}

TEST_F(Render, ComparesTwoTablesInOneMaterial) {
  std::filesystem::create_directory(folder_ / "made");
  const ProgramResult result = run({"t.h5", "--table-b", "t.npy", "--alpha-x", "0.2", "--alpha-y",
                                    "0.4", "--f0", "0.04", "-o", "made/two.png"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(names_in(folder_ / "made"), (std::vector<std::string>{"two.png", "two_0.2_0.4.exr"}));
  EXPECT_NE(result.out.find("B: t.npy"), std::string::npos) << result.out;
  EXPECT_NE(read_file(folder_ / "made/two_0.2_0.4.exr").find("difference_b.Y"), std::string::npos);
}

TEST_F(Render, NamesItsFilesAsTheyWereNamed) {
  const ProgramResult result =
      run({"t.h5", "--alpha-x", "0.2", "--alpha-y", "0.4", "-o", "q.png", "--json", "r.json"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const auto report = nlohmann::json::parse(read_file(folder_ / "r.json"));
  EXPECT_EQ(report["picture"], "q.png");
  EXPECT_EQ(report["materials"][0]["image"], "q_0.2_0.4.exr");
}

TEST_F(Render, TakesMaterialsAndTheSizeOfTheLight) {
  const std::vector<std::string> two{"t.h5", "--material", "0.3,0.05", "--material", "0.2,1", "-o"};
  const auto with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = two;
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramResult result = run(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
  };
  with({"large"});
  with({"same", "--light-size", "1"});
  with({"small", "--light-size", "0.1"});
  EXPECT_EQ(names_in(folder_ / "large"),
            (std::vector<std::string>{"spheres.png", "spheres_0.2_1.exr", "spheres_0.3_0.05.exr"}));
  const auto image = [&](const char* folder) {
    return read_file(folder_ / folder / "spheres_0.3_0.05.exr");
  };
  EXPECT_EQ(image("large"), image("same"));
  EXPECT_NE(image("large"), image("small"));
}

TEST_F(Render, LightsObjectsOfEveryShapeByLightsOfEveryShape) {
  folder_.write("window.png", testing::window_png(16));
  std::vector<std::string> images;
  const std::pair<std::string, std::string> objects[] = {
      {"sphere", "spheres"}, {"plane", "planes"}, {"sheet", "sheets"}};
  for (const auto& [shape, plural] : objects)
    for (const std::string light : {"rectangle", "star", "disk", "sphere", "line", "window.png"}) {
      const ProgramResult result = run({"t.h5", "--material", "0.4,0.4", "--shape", shape,
                                        "--light", light, "-o", "o", "--json", "r.json"});
      ASSERT_EQ(result.exit_code, 0) << result.err;
      images.push_back(read_file(folder_ / "o" / (plural + "_0.4_0.4.exr")));
      const auto report = nlohmann::json::parse(read_file(folder_ / "r.json"));
      EXPECT_EQ(report["shape"], shape);
      EXPECT_EQ(report["light"], light);
      EXPECT_EQ(report["light_position"],
                shape == "sphere" ? nlohmann::json({1, 1.5, 2.1}) : nlohmann::json({0, 1.5, -2}));
      EXPECT_EQ(report["two_sided"], false);
      EXPECT_GT(report["materials"][0]["tables"][0]["reference_mean"], 1e-3);
    }
  std::sort(images.begin(), images.end());
  EXPECT_EQ(std::unique(images.begin(), images.end()), images.end()) << "no two of 18 alike";
}

TEST_F(Render, MovesTheLight) {
  const auto mean = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments{"t.h5", "--material", "0.4,0.4", "-o",
                                       "o",    "--json",     "r.json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramResult result = run(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return nlohmann::json::parse(
               read_file(folder_ / "r.json"))["materials"][0]["tables"][0]["reference_mean"]
        .get<double>();
  };
  EXPECT_EQ(mean({"--light-position", "1,1.5,2.1"}), mean({}));
  EXPECT_LT(mean({"--light-position", "0,0,-3"}), 0.2 * mean({}));
  // Lights face the middle: only what is beyond their plane sees their other side.
  EXPECT_EQ(mean({"--two-sided"}), mean({}));
  EXPECT_GT(mean({"--light-position", "0.3,0.3,0.3", "--two-sided"}),
            1.01 * mean({"--light-position", "0.3,0.3,0.3"}));
}

// roughness 0.3 and anisotropy 0.5 are alpha 0.3175 and 0.09; 0.5 and 0 are 0.25 and 0.25.
TEST_F(Render, TakesRoughnessAsEditorsHaveIt) {
  const ProgramResult result =
      run({"t.h5", "--roughness", "0.5", "--material", "roughness=0.3,anisotropy=0.5", "--material",
           "roughness=0.4", "-o", "o"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  for (const char* row : {"    0.25     0.25", "  0.3175     0.09", "    0.16     0.16"})
    EXPECT_NE(result.out.find(row), std::string::npos) << row << "\n" << result.out;
}

TEST_F(Render, ScalesWhatIsAboveTheHorizon) {
  const auto image_of = [&](const std::string& mode) {
    const ProgramResult result = run({"t.h5", "--material", "0.9,0.4", "--light-size", "2",
                                      "--horizon", mode, "--json", "all.json", "-o", mode});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    const auto json = nlohmann::json::parse(read_file(folder_ / "all.json"));
    EXPECT_EQ(json["horizon"], mode);
    EXPECT_NE(read_file(folder_ / mode / "spheres_0.9_0.4.exr").find(mode), std::string::npos);
    return json["materials"][0]["tables"][0]["mean_absolute_error"].get<double>();
  };
  EXPECT_NE(image_of("clipped"), image_of("scaled"));
  const ProgramResult refused = run({"t.h5", "--horizon", "cut"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("scaled"), std::string::npos) << refused.err;
}

TEST_F(Render, StatesTheNoiseOfItsReference) {
  const auto tables_of = [&](const char* samples, const std::string& mark) {
    const ProgramResult result = run_ltcfit({"render", "t.h5", "--material", "0.5,0.5", "--size",
                                             "24", "--samples", samples, "--json", "all.json"},
                                            folder_.path());
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_NE(result.out.find(" noise "), std::string::npos);
    EXPECT_EQ(result.out.find("raise --samples") != std::string::npos, mark == "!") << result.out;
    return nlohmann::json::parse(read_file(folder_ / "all.json"))["materials"][0]["tables"][0];
  };
  const auto coarse = tables_of("16", "!"), fine = tables_of("16384", "");
  const double noise = fine["noise_over_mean"], rmse = fine["rmse_over_mean"];
  EXPECT_LT(noise, 0.2 * rmse);
  EXPECT_GT(coarse["noise_over_mean"].get<double>(), 10 * noise);
  // Independent of the table's own error, the noise adds to its square: to a tenth, the accuracy of
  // a noise estimated from two halves at some 400 pixels.
  EXPECT_NEAR(coarse["rmse_over_mean"].get<double>(),
              std::hypot(coarse["noise_over_mean"].get<double>(), rmse),
              0.1 * coarse["rmse_over_mean"].get<double>());
}

TEST_F(Render, WarnsOfWhatIsClamped) {
  Grid grid = Grid::paper(3);
  grid.alpha = Axis::make(0.1, 0.6, 3, Warp::linear);
  grid.theta = Axis::make(0, 1, 3, Warp::linear);
  write_table(testing::synthetic_table(grid, Storage::matrix), folder_ / "narrow.h5");
  const ProgramResult result = run({"t.h5", "--table-b", "narrow.h5", "--material", "0.8,0.4",
                                    "--material", "0.5,0.5", "--json", "all.json"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const std::string first =
      "0.8, 0.4 is beyond the axes of narrow.h5, clamped: alpha 0.8 to 0.6, theta 90 to 57.3\n";
  for (const std::string& text : {result.out, result.err}) {
    EXPECT_NE(text.find(first), std::string::npos) << text;
    EXPECT_NE(text.find("0.5, 0.5 is beyond the axes of narrow.h5, clamped: theta 90 to 57.3\n"),
              std::string::npos);
    EXPECT_EQ(text.find("axes of t.h5"), std::string::npos);
  }
  const auto materials = nlohmann::json::parse(read_file(folder_ / "all.json"))["materials"];
  EXPECT_TRUE(materials[0]["tables"][0]["clamped"].empty());
  EXPECT_EQ(materials[0]["tables"][1]["clamped"][0],
            nlohmann::json({{"axis", "alpha"}, {"asked", 0.8}, {"taken", 0.6}}));
}

TEST_F(Render, WritesTheSameBytesWithAnyNumberOfThreads) {
  for (const char* threads : {"1", "3"})
    EXPECT_EQ(run({"t.h5", "--alpha-x", "0.3", "--alpha-y", "0.1", "-t", threads, "-o",
                   std::string("o") + threads})
                  .exit_code,
              0);
  for (const char* name : {"spheres.png", "spheres_0.3_0.1.exr"})
    EXPECT_EQ(read_file(folder_ / "o1" / name), read_file(folder_ / "o3" / name)) << name;
}

TEST_F(Render, RefusesBadInputInOneLineAndWritesNothing) {
  write_table(Table::empty(Grid::paper(2), Storage::matrix), folder_ / "empty.h5");
  folder_.write("no.h5", "not a table");
  const auto expect_refusal = [&](const std::vector<std::string>& arguments, int exit_code,
                                  const std::vector<std::string>& parts) {
    const std::vector<std::string> before = names_in(folder_.path());
    const ProgramResult result = run(arguments);
    EXPECT_EQ(result.exit_code, exit_code) << result.err;
    EXPECT_EQ(result.out, "");
    // Progress may precede it.
    const std::size_t begin = result.err.find("ltcfit: ");
    ASSERT_NE(begin, std::string::npos) << result.err;
    EXPECT_EQ(result.err.back(), '\n');
    expect_one_line(result.err.substr(begin, result.err.size() - begin - 1), parts);
    EXPECT_EQ(names_in(folder_.path()), before);
  };
  for (const char* material :
       {"0.3", "0.3,", "0.3,0.05,1", "0.3,2", "0.3,nan", "x,0.1", "roughness=2",
        "roughness=0.3,0.5", "roughness=0.3,anisotropy=1.1", "anisotropy=0.5"})
    expect_refusal({"t.h5", "--material", material}, 2, {"--material", material, "[0.0001, 1]"});
  for (const char* size : {"0", "nan", "3"})
    expect_refusal({"t.h5", "--light-size", size}, 2, {"--light-size", size, "[0.001, 2]"});
  for (const char* light : {"cone", "x.jpg", ""})
    expect_refusal({"t.h5", "--light", light}, 2, {"--light", light, "rectangle, star", ".exr"});
  for (const char* position :
       {"0", "1,2", "1,2,", "1,2,x", "0,0,0", "1,2,3,4", "nan,0,1", "1,2,2000"})
    expect_refusal({"t.h5", "--light-position", position}, 2,
                   {"--light-position", position, "X,Y,Z"});
  expect_refusal({"t.h5", "--shape", "cube"}, 2, {"--shape cube", "sphere, plane or sheet"});
  expect_refusal({"t.h5", "--light", "none.png"}, 3, {"none.png"});
  folder_.write("bad.png", "no picture");
  expect_refusal({"t.h5", "--light", "bad.png"}, 2, {"bad.png", "no image"});
  expect_refusal({"t.h5", "--light", "bad.png", "-o", "bad.png"}, 2, {"bad.png", "same file"});
  expect_refusal({"t.h5", "--light", "sphere", "--light-position", "0,0,1.2"}, 2,
                 {"sphere light of radius 0.6", "must not touch the object"});
  expect_refusal({}, 2, {"TABLE"});
  expect_refusal({"missing.h5"}, 3, {"missing.h5"});
  expect_refusal({"no.h5"}, 2, {"no.h5"});
  expect_refusal({"t.h5", "--table-b", "no.h5"}, 2, {"no.h5"});
  expect_refusal({"empty.h5"}, 2, {"empty.h5", "none of the entries"});
  expect_refusal({"t.h5", "--alpha-x", "0.5"}, 2, {"--alpha-x", "--alpha-y"});
  expect_refusal({"t.h5", "--alpha-x", "0.5", "--alpha-y", "1.5"}, 2, {"--alpha-y", "1.5"});
  expect_refusal({"t.h5", "--f0", "nan"}, 2, {"nan"});
  expect_refusal({"t.h5", "--output", ""}, 2, {"--output ''", "expected a folder"});
  expect_refusal({"t.h5", "-o", "x.bmp"}, 2, {"--output", "x.bmp", ".png"});
  expect_refusal({"t.h5", "--threads", "0"}, 2, {"--threads", "0"});
}

}  // namespace
}  // namespace ltc::test
