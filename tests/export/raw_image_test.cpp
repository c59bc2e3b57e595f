// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Bare numbers with their description: read back by us and by Python, and what is refused.
#include "export/raw_image.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "export/files.h"
#include "export/images.h"
#include "support/temporary_directory.h"

namespace ltc {
namespace {

using testing::expect_refusal;
using testing::numbered_image;

std::vector<Image> all_kinds() {
  std::vector<Image> images;
  for (const ImageShape shape : testing::all_shapes)
    for (const Precision precision : testing::all_precisions) {
      images.push_back(numbered_image(shape, precision, 3 + images.size()));
      images.back().name = "ltc_" + std::to_string(images.size());
    }
  return images;
}

std::vector<Image> read(const std::string& bytes, const std::string& description) {
  return decode_raw(bytes, description, "x.bin", "x.json");
}

TEST(RawImage, EveryShapeAndPrecisionIsReadBack) {
  const std::vector<Image> images = all_kinds();
  EXPECT_EQ(images.back().channels, 8u);
  EXPECT_EQ(read(encode_raw(images), describe_raw(images)), images);
}

TEST(RawImage, TheDescriptionAndTheBytesAreThese) {
  Image image = numbered_image(ImageShape::flat, Precision::half, 2, 1, 1);
  image.name = "ltc_1";
  image.values = {1, -2};
  EXPECT_EQ(nlohmann::json::parse(describe_raw({image})), nlohmann::json::parse(R"({"images": [
    {"name": "ltc_1", "shape": "flat", "width": 1, "height": 1, "layers": 1, "channels": 2,
     "precision": "half"}]})"));
  EXPECT_EQ(encode_raw({image}), std::string("\x00\x3c\x00\xc0", 4));
  image.precision = Precision::single;
  EXPECT_EQ(encode_raw({image}), std::string("\x00\x00\x80\x3f\x00\x00\x00\xc0", 8));
}

TEST(RawImage, NumpyFindsTheSameNumbers) {
  const test::TemporaryDirectory folder;
  const std::vector<Image> images = all_kinds();
  folder.write("x.bin", encode_raw(images));
  folder.write("x.json", describe_raw(images));
  folder.write("sum.py",
               "import json, numpy\nbytes = open('x.bin', 'rb').read()\n"
               "for i in json.load(open('x.json'))['images']:\n"
               "  t = '<f2' if i['precision'] == 'half' else '<f4'\n"
               "  shape = i['layers'], i['height'], i['width'], i['channels']\n"
               "  n = numpy.prod(shape) * int(t[2])\n"
               "  a = numpy.frombuffer(bytes[:n], t).reshape(shape)\n"
               "  bytes = bytes[n:]\n"
               "  print(i['name'], float(a[-1, 1, 2, 1]))\nprint(len(bytes))\n");
  std::string expected;
  for (const Image& image : images) {
    const std::size_t texel = ((image.layers - 1) * 3 + 1) * 5 + 2;
    expected += fmt::format("{} {}\n", image.name, image.values[texel * image.channels + 1]);
  }
  EXPECT_EQ(testing::run("cd " + folder.path().string() + " && /usr/bin/python3 sum.py").output,
            expected + "0\n");
}

TEST(RawImage, OtherFilesAreRefusedByFault) {
  const std::vector<Image> images = {numbered_image(ImageShape::array, Precision::half)};
  const std::string bytes = encode_raw(images), description = describe_raw(images);
  expect_refusal([&] { read(bytes + '\0', description); },
                 "x.bin: 241 bytes long; x.json asks for 240");
  expect_refusal([&] { read(bytes.substr(1), description); }, "239 bytes long");
  expect_refusal([&] { read("", description); }, "0 bytes long");
  const auto with = [&](const char* key, const nlohmann::json& value) {
    nlohmann::json changed = nlohmann::json::parse(description);
    if (value.is_null())
      changed["images"][0].erase(key);
    else
      changed["images"][0][key] = value;
    return changed.dump();
  };
  const std::pair<std::string, std::string> cases[] = {
      {"", "x.json: it describes no images; allowed: {\"images\": [...]}"},
      {"[]", "it describes no images"},
      {"{}", "it describes no images"},
      {R"({"images": []})", "it describes no images"},
      {R"({"images": {}})", "it describes no images"},
      {description.substr(0, description.size() - 3), "it describes no images"},
      {R"({"images": [4]})", "x.json: image 0 has no name; allowed: a text"},
      {std::string((1 << 20) + 1, ' '), "1048577 bytes long; allowed: 1048576"},
      {with("name", nullptr), "has no name"},
      {with("name", 4), "has no name"},
      {with("shape", "cube"), "image 0: shape \"cube\" is unknown; allowed: flat, array, volume"},
      {with("shape", "cu\nbe"), "shape \"cu be\" is unknown"},
      {with("shape", "flat"), "flat, with 2 layers; allowed: 1"},
      {with("precision", "double"), "precision \"double\" is unknown; allowed: single, half"},
      {with("precision", nullptr), "has no precision; allowed: a text"},
      {with("width", nullptr), "has no width; allowed: a whole number"},
      {with("width", -1), "has no width; allowed: a whole number"},
      {with("width", 5.0), "has no width; allowed: a whole number"},
      {with("height", 0), "5 x 0 x 2 texels"},
      {with("layers", 1ull << 62), "x 4611686018427387904 texels"},
      {with("channels", 10), "of 10 channels; allowed"},
      {with("height", 4), "x.bin: 240 bytes long; x.json asks for 320"},
  };
  for (const auto& [text, fault] : cases)
    expect_refusal([&, &source = text] { read(bytes, source); }, fault);
  expect_refusal([] { encode_raw({}); }, "no images");
  expect_refusal([] { describe_raw({}); }, "no images");
}

TEST(RawImage, EnginesFilesNeedNoDescription) {
  const Image eight = numbered_image(ImageShape::flat, Precision::half, 8, 3, 3);
  EXPECT_EQ(decode_bare(encode_raw({eight}), "areaLightsLTC.bin"), std::vector<Image>{eight});
  const Image four = numbered_image(ImageShape::flat, Precision::single, 4, 2, 2);
  const std::string playcanvas = std::string("\0\0\1\0", 4) + encode_raw({four, four});
  EXPECT_EQ(decode_bare(playcanvas, "t.bin"), (std::vector<Image>{four, four}));
  for (const std::string& bytes : {std::string(), std::string(15, '\0'), std::string(32, '\0'),
                                   playcanvas + '\0', playcanvas.substr(0, playcanvas.size() - 16)})
    expect_refusal([&] { decode_bare(bytes, "t.bin"); }, "and no t.bin.json beside it");
}

TEST(RawImage, ValuesThatCannotBeStoredAreRefused) {
  Image image = numbered_image(ImageShape::flat, Precision::half);
  image.values[1] = -65505;
  expect_refusal([&] { encode_raw({image}); }, "is -65505; 16 bits hold finite values up to 65504");
  expect_refusal([&] { describe_raw({image}); }, "is -65505");
}

}  // namespace
}  // namespace ltc
