// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Numbers in text: read back by us, by compilers and interpreters, others' ways of writing, and
// what is refused.
#include "export/number_text.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "export/files.h"
#include "export/images.h"
#include "support/temporary_directory.h"

namespace ltc {
namespace {

using testing::expect_refusal;
using testing::numbered_image;

using Images = std::vector<Image>;

Images json(const std::string& text) {
  return decode_json(text, "x.json");
}
Images program(const std::string& text) {
  return decode_number_lists(text, "x.js");
}

// One of each shape and precision, with values that are hard to write: the least and the largest,
// and those of evenly spread bits.
Images hard_images() {
  Images images;
  for (const ImageShape shape : testing::all_shapes)
    for (const Precision precision : testing::all_precisions) {
      Image image = numbered_image(shape, precision, 3, 7, 5);
      image.name = "ltc_" + std::to_string(images.size() + 1);
      if (precision == Precision::single)
        for (std::size_t i = 0; i < image.values.size(); ++i) {
          const float value = std::bit_cast<float>(static_cast<std::uint32_t>(i * 2654435769u));
          if (std::isfinite(value))
            image.values[i] = value;
        }
      image.values[0] = -0.0f;
      image.values[1] = precision == Precision::half ? 65504.0f : std::numeric_limits<float>::max();
      image.values[2] = precision == Precision::half ? 0x1p-24f : 0x1p-149f;
      images.push_back(image);
    }
  return images;
}

void expect_same(const Images& found, const Images& images) {
  ASSERT_EQ(found.size(), images.size());
  for (std::size_t i = 0; i < images.size(); ++i) {
    EXPECT_EQ(found[i].name, images[i].name);
    EXPECT_EQ(found[i].shape, images[i].layers == 1 ? ImageShape::flat : ImageShape::array);
    EXPECT_EQ(found[i].width, images[i].width);
    EXPECT_EQ(found[i].height, images[i].height);
    EXPECT_EQ(found[i].layers, images[i].layers);
    EXPECT_EQ(found[i].channels, images[i].channels);
    EXPECT_EQ(found[i].precision, Precision::single);
    ASSERT_EQ(found[i].values.size(), images[i].values.size());
    for (std::size_t k = 0; k < images[i].values.size(); ++k)
      ASSERT_EQ(std::bit_cast<std::uint32_t>(found[i].values[k]),
                std::bit_cast<std::uint32_t>(images[i].values[k]))
          << k;
  }
}

TEST(NumberText, EveryFloatIsReadBack) {
  const Images images = hard_images();
  expect_same(json(encode_json(images)), images);
  expect_same(program(encode_javascript(images)), images);
  expect_same(program(encode_c_header(images, "LTC_H")), images);
}

TEST(NumberText, TheTextsAreThese) {
  Image image;
  image.name = "ltc_1";
  image.width = 2;
  image.height = 1;
  image.channels = 2;
  image.precision = Precision::half;
  image.values = {0.1f, 1, -2e-5f, 65504};
  EXPECT_EQ(encode_json({image}),
            "{\n\"size\": {\"ltc_1\": [2, 1, 1, 2]},\n\"ltc_1\": [\n0.099975586, 1,\n"
            "-2.002716e-05, 65504\n]\n}\n");
  EXPECT_EQ(encode_javascript({image}),
            "/* width 2, height 1, layers 1, channels 2 */\nexport const ltc_1 = [\n"
            "0.099975586, 1,\n-2.002716e-05, 65504\n];\n");
  EXPECT_EQ(encode_c_header({image}, "LTC_H"),
            "#ifndef LTC_H\n#define LTC_H\n\n/* width 2, height 1, layers 1, channels 2 */\n"
            "static const float ltc_1[4] = {\n0.099975586f, 1.0f,\n-2.002716e-05f, 65504.0f\n};\n"
            "\n#endif\n");
}

// The bits of every value, a line each.
std::string bits_of(const Images& images) {
  std::string text;
  for (const Image& image : images)
    for (const float value : image.values)
      text += fmt::format("{:08x}\n", std::bit_cast<std::uint32_t>(value));
  return text;
}

TEST(NumberText, CompilersAndInterpretersFindTheSameBits) {
  const test::TemporaryDirectory folder;
  const Images images = hard_images();
  const std::string in_folder = "cd " + folder.path().string() + " && ";
  folder.write("ltc.h", encode_c_header(images, "LTC_H"));
  std::string c =
      "#include <stdio.h>\n#include <string.h>\n#include \"ltc.h\"\n#include \"ltc.h\"\n"
      "static void print(const float *v, unsigned n) {\n"
      "  for (unsigned i = 0, b; i < n; ++i) memcpy(&b, v + i, 4), printf(\"%08x\\n\", b);"
      "\n}\nint main(void) {\n";
  for (const Image& image : images)
    c += fmt::format("print({0}, sizeof {0} / 4);\n", image.name);
  folder.write("print.c", c + "return 0;\n}\n");
  const auto compiled =
      testing::run(in_folder + "cc -std=c99 -Wall -Wextra -Werror print.c -o print && ./print");
  EXPECT_EQ(compiled.output, bits_of(images));

  folder.write("ltc.json", encode_json(images));
  folder.write("print.py",
               "import json, struct\nfound = json.load(open('ltc.json'))\n"
               "for name in found['size']:\n  for v in found[name]:\n"
               "    print('%08x' % struct.unpack('I', struct.pack('f', v)))\n");
  EXPECT_EQ(testing::run(in_folder + "/usr/bin/python3 print.py").output, bits_of(images));

  if (testing::run("node --version").exit_code != 0)
    GTEST_SKIP() << "no node to read the JavaScript";
  folder.write("ltc.mjs", encode_javascript(images));
  folder.write("print.mjs",
               "import * as ltc from './ltc.mjs';\nfor (const list of Object.values(ltc))\n"
               "  for (const bits of new Uint32Array(new Float32Array(list).buffer))\n"
               "    console.log(bits.toString(16).padStart(8, '0'));\n");
  EXPECT_EQ(testing::run(in_folder + "node print.mjs").output, bits_of(images));
}

TEST(NumberText, WhatCannotBeWrittenIsRefused) {
  Image image = numbered_image(ImageShape::flat, Precision::single);
  image.name = "ltc_1";
  const auto expect = [](const Images& images, const std::string& part) {
    expect_refusal([&] { encode_json(images); }, part);
    expect_refusal([&] { encode_javascript(images); }, part);
    expect_refusal([&] { encode_c_header(images, "LTC_H"); }, part);
  };
  expect({}, "no images");
  expect({image, image}, "image name \"ltc_1\" stands twice");
  Image bad = image;
  bad.name = "";
  expect({image, bad}, "image name \"\"; allowed:");
  bad = image;
  bad.values[7] = std::numeric_limits<float>::infinity();
  expect({bad}, "image ltc_1: channel 3 of texel (1, 0) in layer 0 is inf; 32 bits hold");
  bad.values[7] = 65536;
  bad.precision = Precision::half;
  expect({bad}, "is 65536; 16 bits hold");
  image.name = "size";
  expect_refusal([&] { encode_json({image}); }, "image name \"size\"; allowed:");
  EXPECT_NO_THROW(encode_javascript({image}));
  for (const char* const name : {"1a", "a b", "a-b", "x;alert(1)"}) {
    image.name = name;
    EXPECT_EQ(json(encode_json({image}))[0].name, name);
    expect_refusal([&] { encode_javascript({image}); }, "letters, digits and _");
    expect_refusal([&] { encode_c_header({image}, "LTC_H"); }, "letters, digits and _");
  }
  image.name = "a";
  expect_refusal([&] { encode_c_header({image}, "LTC.H"); }, "include guard \"LTC.H\"; allowed");
}

TEST(NumberText, OthersWaysOfWritingAreRead) {
  // PlayCanvas's.
  const Images pair = json(R"({"LTC_MAT_1":[1,0,0,-4.5e-07],"LTC_MAT_2":[1,2,3,[4]]})");
  ASSERT_EQ(pair.size(), 2u);
  EXPECT_EQ(pair[0].name, "LTC_MAT_1");
  EXPECT_EQ(pair[0].values, (std::vector<float>{1, 0, 0, -4.5e-07f}));
  EXPECT_EQ(pair[1].values, (std::vector<float>{1, 2, 3, 4}));
  // three.js's.
  const Images script = program(
      "// LTC_MAT_0 = [ 1 ];\nimport { DataUtils } from 'three';\nclass Lib {\n\tstatic init() {\n"
      "\t\tif ( a == [ 1 ] || b => [ 2 ] ) c = [ d, 1 ];\n"
      "\t\tconst LTC_MAT_1 = [ 2e-05, - 4.48e-07, /* 9, */ .5, 1., ];\n"
      "\t\tconst a = [], b = { x: [ 1 ] }, s = 'x = [1', t = \"\\\" = [1\";\n"
      "\t\tconst LTC_MAT_2 = [ 1, 2, 3, 4, + 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16 ];\n}}\n");
  ASSERT_EQ(script.size(), 2u);
  EXPECT_EQ(script[0].name, "LTC_MAT_1");
  EXPECT_EQ(script[0].values, (std::vector<float>{2e-05f, -4.48e-07f, 0.5f, 1}));
  EXPECT_EQ(script[1].name, "LTC_MAT_2");
  EXPECT_EQ(script[1].width, 2u);
  EXPECT_EQ(script[1].values[5], 6);
  // ltc_code's, in C.
  const Images c = program(
      "#include \"x = [\"\nstatic const int size = 1;\n"
      "static const mat33 tabM[size*size] = {\n  {1, -2.5E-3f}, {1F, 1e-60}, };\n"
      "const float tab[1][ 2 ][2] = {{{1, 2}, {3, 4}}};");
  ASSERT_EQ(c.size(), 2u);
  EXPECT_EQ(c[0].name, "tabM");
  EXPECT_EQ(c[0].values, (std::vector<float>{1, -2.5e-3f, 1, 0}));
  EXPECT_EQ(c[1].name, "tab");
  EXPECT_EQ(c[1].values, (std::vector<float>{1, 2, 3, 4}));
}

// Unity's: its own way of writing, and ours.
TEST(NumberText, CSharpIsTheBitsOfHalves) {
  const Images read = program(
      "internal static ushort[] s_Ltc = new ushort[1 * 1 * 4]\n{\n  // Cos = [1\n"
      "  24528, 0, 48128, 1, // alpha = 0.001\n};\nb = new ushort[4] { 15360, 32768, 31743, 64511, "
      "};\n"
      "double[,] s_Nine = new double[1, 3 * 3] { {1, 2, 3, 4, 5, 6, 7, 8, 9} };");
  ASSERT_EQ(read.size(), 3u);
  EXPECT_EQ(read[0].precision, Precision::half);
  EXPECT_EQ(read[0].values, (std::vector<float>{500, 0, -1, 0x1p-24f}));
  EXPECT_EQ(read[1].values, (std::vector<float>{1, -0.0f, 65504, -65504}));
  EXPECT_EQ(read[2].precision, Precision::single);
  EXPECT_EQ(read[2].channels, 9u);
  Image image = numbered_image(ImageShape::flat, Precision::half, 4, 2, 2);
  image.name = "s_Ltc";
  const Images back = program(encode_c_sharp({image}));
  ASSERT_EQ(back.size(), 1u);
  EXPECT_EQ(back[0], image);
  const Images uneven = program("a = new ushort[3 * 1 * 2] { 1, 2, 3, 4, 5, 6 };");
  EXPECT_EQ(uneven[0].width, 3u);
  EXPECT_EQ(uneven[0].channels, 2u);
  EXPECT_NE(encode_c_sharp({image}).find("ushort[] s_Ltc = new ushort[2 * 2 * 4]"),
            std::string::npos);
  image.precision = Precision::single;
  image.values[3] = 65520;
  expect_refusal([&] { encode_c_sharp({image}); }, "is 65520; 16 bits hold finite values up to");
  expect_refusal([] { program("a = new ushort[4] { 0, 1, 65536, 3 }"); },
                 "list a: 65536; allowed: the bits of a half");
  expect_refusal([] { program("a = new ushort[4] { 0, 1, 1.5, 3 }"); }, "list a: 1.5; allowed");
}

TEST(NumberText, NestedListsSayTheirSize) {
  const auto size_of = [](const std::string& text) {
    const Images images = program(text);
    return std::vector<std::size_t>{images[0].width, images[0].height, images[0].channels};
  };
  EXPECT_EQ(size_of("a = {{{1, 2}, {3, 4}, {5, 6}}, {{1, 2}, {3, 4}, {5, 6}}}"),
            (std::vector<std::size_t>{3, 2, 2}));
  EXPECT_EQ(size_of("a = {{1}, {3}, {5}, {7}}"), (std::vector<std::size_t>{2, 2, 1}));
  EXPECT_EQ(size_of("a = {{1, 2}, {3, 4}}"), (std::vector<std::size_t>{1, 1, 4}));  // no square
  EXPECT_EQ(size_of("a = {{1, 2, 3}, {4}}"), (std::vector<std::size_t>{1, 1, 4}));  // uneven
  // Beside matrices, ltc_code's bare list has one number a matrix; by itself it is a square.
  const std::string nine = "{1, 0, 0, 0, 1, 0, 0, 0, 1}";
  const Images both = program("m = {" + nine + ", " + nine + ", " + nine + ", " + nine +
                              "}; amplitude = {1, 2, 3, 4}");
  EXPECT_EQ(both[1].channels, 1u);
  EXPECT_EQ(both[1].width, 2u);
  expect_refusal([] { program("a = {{1, 2, 3, 4, 5, 6, 7, 8, 9, 10}}"); }, "of 10 channels");
}

TEST(NumberText, CountsThatAreNotThoseOfTheSizeAreRefused) {
  expect_refusal([] { json(R"({"a":[1,2,3]})"); },
                 "x.json: list a has 3 numbers; allowed without a size: 4 n^2");
  expect_refusal([] { json(R"({"a\nb":[1]})"); }, "list a b has 1 numbers");
  expect_refusal([] { json(R"({"a\nb":[1e39]})"); }, "list a b: \"1e39\"");
  expect_refusal([] { json(R"({"size":{"size":[1,1,1,1]},"a":[1,2,3,4]})"); },
                 "it has a size of size, but no such list");
  expect_refusal([] { json(R"({"a":[]})"); }, "list a has 0 numbers");
  expect_refusal([] { json(R"({"a":[1,2,3],"size":{"a":[2,1,1,2]}})"); },
                 "list a has 3 numbers; its size asks for 4");
  expect_refusal([] { json(R"({"a":[1,2,3],"size":{"a":[3,1,1]}})"); }, "size of a has 3 numbers");
  expect_refusal([] { json(R"({"a":[1,2,3],"size":{"a":[3,1,1,1],"b":[1,1,1,1]}})"); },
                 "it has a size of b, but no such list");
  expect_refusal([] { json(R"({"size":{"a":[1099511627776,1099511627776,1,1]},"a":[1]})"); },
                 "1099511627776 x 1099511627776 x 1 texels of 1 channels; allowed: 1 to 16384");
  EXPECT_EQ(json(R"({"a":[1,2,3],"size":{"a":[3,1,1,1]}})")[0].width, 3u);
  expect_refusal([] { program("a = [1, 2, 3];"); }, "list a has 3 numbers; allowed without");
  expect_refusal([] { program("/* width 2, height 1, layers 1, channels 1 */ a = [1, 2, 3];"); },
                 "list a has 3 numbers; its size asks for 2");
}

TEST(NumberText, OtherJsonIsRefusedByFault) {
  const std::string deep(100000, '[');
  const std::pair<std::string, std::string> cases[] = {
      {"", "no JSON"},
      {"[1, 2, 3, 4]", "it is a list; allowed: an object of lists of numbers"},
      {"4", "it is a number"},
      {"{}", "it has no lists"},
      {R"({"size":{}})", "it has no lists"},
      {R"({"size":[1,2,3,4]})", "\"size\" has a list"},
      {R"({"size":4,"a":[1,2,3,4]})", "\"size\" has a number"},
      {R"({"size":{"a":4},"a":[1,2,3,4]})", "\"a\" has 4"},
      {R"({"size":{"a":[1,1,1,4,1]},"a":[1,2,3,4]})", "\"a\" has 1"},
      {R"({"size":{"a":[1,1,1,-4]},"a":[1,2,3,4]})", "\"a\" has -4"},
      {R"({"size":{"a":[1,1,1,4.0]},"a":[1,2,3,4]})", "\"a\" has 4.0"},
      {R"({"size":{"a":[1,1,1,[4]]},"a":[1,2,3,4]})", "\"a\" has a list"},
      {R"({"size":{"a":{}},"a":[1,2,3,4]})", "\"a\" has an object"},
      {R"({"a":[1,2,3,"4"]})", "\"a\" has a text"},
      {R"({"a":[1,2,3,null]})", "\"a\" has null"},
      {R"({"a":[1,2,3,true]})", "\"a\" has true or false"},
      {R"({"a":[1,2,3,{}]})", "\"a\" has an object"},
      {R"({"a":"b"})", "\"a\" has a text"},
      {R"({"a":[1,2,3,4],"a":[1,2,3,4]})", "\"a\" stands twice"},
      {R"({"a":[1,2,3,4)", "no JSON: the fault is at byte 14"},
      {R"({"a":[1,2,3,NaN]})", "no JSON"},
      {R"({"a":[1,2,3,1e39]})", "list a: \"1e39\"; allowed: a finite number of 32 bits"},
      {R"({"a":[1,2,3,1e999]})", "x.json: "},
      {R"({"a":)" + deep, "no JSON"},
      {deep, "it is a list"},
  };
  for (const auto& [text, fault] : cases)
    expect_refusal([&] { json(text); }, fault);
  EXPECT_EQ(json(R"({"a":[1e-60,2e-45,18446744073709551615,-9]})")[0].values,
            (std::vector<float>{0, 0x1p-149f, 0x1p64f, -9}));
}

TEST(NumberText, OtherProgramsAreRefusedByFault) {
  const std::pair<std::string, std::string> cases[] = {
      {"", "it has no lists of numbers; allowed: name = [...] or name[...] = {...}"},
      {"[1, 2, 3, 4]", "it has no lists"},
      {"= [1, 2, 3, 4]", "it has no lists"},
      {"a = [b, 1, 2, 3]", "it has no lists"},
      {"a = []", "it has no lists"},
      {"a == [1, 2, 3, 4]", "it has no lists"},
      {"a[", "it has no lists"},
      {"a =", "it has no lists"},
      {"a = {", "it has no lists"},
      {"'a = [1, 2, 3, 4]", "it has no lists"},
      {"\n\n/* a", "the comment of line 3 does not end"},
      {"a = [1, /* 2", "the comment of line 1 does not end"},
      {"\na = [1, 2, 3, 4", "line 2: the file ends where the list a has a comma or its end"},
      {"a = [1, 2, 3, 4}", "line 1: there is '}' where the list a has a comma or its end"},
      {"a = [1, 2, 3, x]", "there is 'x' where the list a has a finite number"},
      {"a = [1, 2, 3, NaN]", "there is 'N' where the list a has a finite number"},
      {"a = [NaN, 2, 3, 4]", "there is 'N' where the list a has a finite number"},
      {"a = [1, 2, 3, -Infinity]", "list a: \"Infinity\"; allowed: a finite number"},
      {"a = [1, 2, 3, -nan]", "list a: \"nan\"; allowed"},
      {"a = [1, 2, 3, - ]", "list a: \"\"; allowed"},
      {"a = [1, 2, 3, --4]", "list a: \"\"; allowed"},
      {"a = [1, 2, 3, 4e]", "list a: \"4e\"; allowed"},
      {"a = [1, 2, 3, 4ff]", "list a: \"4f\"; allowed"},
      {"a = [1, 2, 3, 0x4]", "list a: \"0x4\"; allowed"},
      {"a = [1, 2, 3, 1.2.3]", "list a: \"1.2.3\"; allowed"},
      {"a = [1, 2, 3, 1e39]", "list a: \"1e39\"; allowed"},
      {"a = [1, 2, 3, 1e999]", "list a: \"1e999\"; allowed"},
      {"a = [1, 2 3, 4]", "there is '3' where the list a has a comma or its end"},
      {"a = [1, 2,, 4]", "there is ',' where the list a has a finite number"},
      {"a = {{1, 2} {3, 4}}", "the list a has a comma"},
      {"a = [1, 2, 3, \x01]", "there is byte 1 where"},
      {"a = [1, 2, 3, 4]; a = [1, 2, 3, 4]", "the list a stands twice"},
      {"a = " + std::string(100000, '['), "it has no lists"},
  };
  for (const auto& [text, fault] : cases)
    expect_refusal([&, &source = text] { program(source); }, fault);
}

}  // namespace
}  // namespace ltc
