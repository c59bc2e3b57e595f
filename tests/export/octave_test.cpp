// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "export/octave.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <string>
#include <vector>

#include "export/images.h"

namespace ltc {
namespace {

using testing::expect_refusal;

std::string matrix(const std::string& name, const std::string& size, const std::string& values) {
  return fmt::format("# name: {}\n# type: matrix\n# ndims: 2\n {}\n{}\n\n", name, size, values);
}

// Of one row and two columns; entry (column, row) of the first is 10 column + row.
std::string whole(const std::string& missing = "") {
  std::string text = matrix("tabMagnitude", "1 2", "0.5 1e-3 ");
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row)
      if (const std::string name = fmt::format("tab{}{}", column, row); name != missing)
        text += matrix(name, "1 2", fmt::format("{} -1 ", 10 * column + row));
  return text;
}

std::vector<Image> read(const std::string& text) {
  return decode_octave(text, "x.mat");
}

TEST(Octave, IsReadColumnByColumn) {
  const std::vector<Image> images = read(whole());
  ASSERT_EQ(images.size(), 2u);
  EXPECT_EQ(images[0].width, 2u);
  EXPECT_EQ(images[0].height, 1u);
  EXPECT_EQ(images[0].values, (std::vector<float>{0, 1, 2, 10, 11, 12, 20, 21, 22, -1, -1, -1, -1,
                                                  -1, -1, -1, -1, -1}));
  EXPECT_EQ(images[1].values, (std::vector<float>{0.5f, 1e-3f}));
}

TEST(Octave, OtherTextIsRefusedByFault) {
  const std::pair<std::string, std::string> cases[] = {
      {"", "x.mat: it has no matrix tab00"},
      {whole("tab12"), "it has no matrix tab12"},
      {whole() + matrix("tab00", "1 2", "1 2"), "the matrix tab00 stands twice"},
      {whole("tab22") + matrix("tab22", "2 1", "1 2"), "tab22 is 2 x 1; expected 1 x 2, as tab00"},
      {matrix("tab00", "two", "1 2"), "tab00 has no size; allowed: two whole numbers"},
      {matrix("tab00", "1152921504606846976 2", "1 2"), "2 x 1152921504606846976 x 1 texels"},
      {matrix("tab00", "1 3", "1 2"), "list tab00: \"\"; allowed"},
      {matrix("tab00", "1 2", "1 nan"), "list tab00: \"nan\"; allowed"},
      {"# name: tab00\n# type: scalar\n1\n", "tab00 is no matrix of two dimensions"},
  };
  for (const auto& [text, fault] : cases)
    expect_refusal([&, &source = text] { read(source); }, fault);
}

}  // namespace
}  // namespace ltc
