// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "render/sphere_picture.h"

#include <ImfArray.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfStringAttribute.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "brdf/albedo.h"
#include "core/error.h"
#include "render/image_exr.h"
#include "render/missing_albedo.h"
#include "support/refusal.h"
#include "support/temporary_directory.h"
#include "table/synthetic.h"

namespace ltc {
namespace {

picture::Field flat(std::size_t size, float value) {
  return {size, size, std::vector<float>(size * size, value)};
}

// GGX half as bright as the LTC, everywhere.
SphereRow flat_row(std::size_t size, float reference, float ltc) {
  return {{0.5, 0.25, 1}, {flat(size, 1), flat(size, reference), flat(size, 0), {flat(size, ltc)}}};
}

int count_of(const picture::Canvas& canvas, const picture::Color& color) {
  int count = 0;
  for (int y = 0; y < canvas.height(); ++y)
    for (int x = 0; x < canvas.width(); ++x)
      count += canvas.pixel(x, y) == color;
  return count;
}

TEST(SpherePicture, SharesOneExposureAndShowsTheSign) {
  constexpr std::size_t size = 200;
  SpherePicture content;
  content.tables = {"LTC"};
  content.rows = {flat_row(size, 0.2f, 0.1f)};
  const picture::Canvas canvas = draw(content);
  // GGX at 0.9 and the LTC at half of it, in sRGB: 243 and 179 of 255, 90 % of each square being
  // enough where lines may cross it.
  constexpr int most = 9 * size * size / 10;
  EXPECT_GE(count_of(canvas, picture::Color::hex(0xf3f3f3)), most);
  EXPECT_GE(count_of(canvas, picture::Color::hex(0xb3b3b3)), most);
  // The difference, -0.1, is the lower end of its scale: blue.
  EXPECT_GE(count_of(canvas, picture::Color::hex(0x062b5f)), most);
}

TEST(SpherePicture, ShowsWhereATableHasNothing) {
  SpherePicture content;
  content.tables = {"LTC"};
  content.rows = {flat_row(200, 0.2f, std::numeric_limits<float>::quiet_NaN())};
  // Image and difference alike.
  EXPECT_GE(count_of(draw(content), picture::Color::hex(0xb8b8b8)), 2 * 9 * 200 * 200 / 10);
}

// Of small spheres rows are as high as what stands beside them: 3 lines and, a table, 4 more, in
// the smallest font that there is.
TEST(SpherePicture, HasRoomForTheWordsOfTwoTables) {
  const auto row_height = [](std::size_t size, std::size_t tables) {
    SpherePicture content;
    content.tables = std::vector<std::string>(tables, "LTC");
    SphereRow row = flat_row(size, 0.2f, 0.1f);
    row.images.ltc.resize(tables, row.images.ltc[0]);
    content.rows = {row};
    const int one = draw(content).height();
    content.rows.push_back(row);
    return draw(content).height() - one;
  };
  EXPECT_NEAR(row_height(8, 1), 160 + 0.7 * 12, 1);  // the least of an image, and a gap
  const double lines = 2 * 12 + (1 + 2 * 4) * 0.8 * 12;
  EXPECT_GE(row_height(8, 2), 1.2 * lines);
  EXPECT_GT(row_height(8, 2), row_height(8, 1));
  EXPECT_EQ(row_height(320, 2), row_height(320, 1));
}

TEST(SpherePicture, RefusesNothing) {
  SpherePicture content;
  EXPECT_THROW(draw(content), InputError);
  content.rows = {flat_row(8, 1, 1)};
  EXPECT_THROW(draw(content), InputError);
}

TEST(ImageExr, HoldsLayersAndAttributes) {
  const test::TemporaryDirectory folder;
  picture::Field first{3, 2, {0, 1, 2, 3, 4, 5}}, second{3, 2, {9, 8, 7, 6, 5, 0.1f}};
  const ImageLayer layers[] = {{"ggx.Y", &first}, {"ltc.Y", &second}};
  const ImageAttribute attributes[] = {{"ltc:material", "alpha_x 0.5"}};
  const auto path = folder / "image.exr";
  write_image_exr(layers, attributes, path);

  Imf::InputFile file(path.string().c_str());
  EXPECT_EQ(file.header().typedAttribute<Imf::StringAttribute>("ltc:material").value(),
            "alpha_x 0.5");
  for (const ImageLayer& layer : layers) {
    std::vector<float> values(6, -1);
    Imf::FrameBuffer buffer;
    buffer.insert(layer.channel, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()),
                                            sizeof(float), 3 * sizeof(float)));
    file.setFrameBuffer(buffer);
    file.readPixels(0, 1);
    EXPECT_EQ(values, layer.image->values);
  }
  const std::string bytes = test::read_file(path);
  write_image_exr(layers, attributes, path);
  EXPECT_EQ(test::read_file(path), bytes);
}

TEST(ImageExr, RefusesLayersOfDifferentSizes) {
  const test::TemporaryDirectory folder;
  picture::Field first{2, 1, {0, 1}}, second{1, 2, {0, 1}};
  const ImageLayer layers[] = {{"ggx.Y", &first}, {"ltc.Y", &second}};
  test::expect_one_line(
      test::message_of<InputError>([&] { write_image_exr(layers, {}, folder / "image.exr"); }),
      {"image.exr", "ltc.Y", "2 x 1"});
  test::expect_one_line(
      test::message_of<InputError>([&] { write_image_exr({}, {}, folder / "image.exr"); }),
      {"image.exr"});
  EXPECT_TRUE(test::names_in(folder.path()).empty());
}

TEST(MissingAlbedo, IsIntegratedAndTheRestKept) {
  Table table = testing::synthetic_table(Grid::paper(2), Storage::matrix);
  const Table before = table;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  table.amplitude[5] = table.fresnel[5] = nan;
  table.fresnel[9] = nan;
  table.amplitude[3] = nan;
  table.status[3] = Status::skipped;
  fill_missing_albedo(table);
  for (const std::size_t flat : {5, 9}) {
    const Albedo albedo = integrate_albedo(table.grid.lobe(flat), AlbedoRule());
    EXPECT_EQ(table.amplitude[flat], static_cast<float>(albedo.amplitude));
    EXPECT_EQ(table.fresnel[flat], static_cast<float>(albedo.fresnel));
  }
  EXPECT_TRUE(std::isnan(table.amplitude[3]));
  EXPECT_EQ(table.amplitude[7], before.amplitude[7]);
  EXPECT_EQ(table.fresnel[7], before.fresnel[7]);
}

}  // namespace
}  // namespace ltc
