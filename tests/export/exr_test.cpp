// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// EXR: pixels and header by OpenEXR's own library and tools, our reader, what stands in for skipped
// entries, and everything that must be refused.
#include "export/table_file.h"

#include <ImfChannelList.h>
#include <ImfDoubleAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfIntAttribute.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "export/files.h"
#include "export/nearest.h"
#include "export/same_tables.h"
#include "table/synthetic.h"

namespace ltc {
namespace {

using testing::bytes_of;
using testing::Finished;
using testing::TemporaryFolder;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

Table example() {
  return testing::synthetic_table(testing::uneven_grid(), Storage::mirror_frame);
}

void skip(Table& table, std::size_t entry) {
  table.set_stored(entry, Eigen::Matrix3d::Constant(nan));
  table.amplitude[entry] = table.fresnel[entry] = nan;
  table.status[entry] = Status::skipped;
}

// One channel as OpenEXR reads it, row by row.
struct Image {
  int width, height;
  std::vector<float> values;
  float at(std::size_t x, std::size_t y) const {
    return values[y * static_cast<std::size_t>(width) + x];
  }
};

Image read_channel(const std::filesystem::path& path, const char* channel) {
  Imf::InputFile file(path.c_str());
  const auto& window = file.header().dataWindow();
  Image image{window.max.x - window.min.x + 1, window.max.y - window.min.y + 1, {}};
  image.values.resize(static_cast<std::size_t>(image.width * image.height), nan);
  Imf::FrameBuffer buffer;
  buffer.insert(channel,
                Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(image.values.data()), sizeof(float),
                           sizeof(float) * static_cast<std::size_t>(image.width)));
  file.setFrameBuffer(buffer);
  file.readPixels(window.min.y, window.max.y);
  return image;
}

// What a channel of a file must hold at an entry, written out from the table of docs/files.md.
float expected_value(const Table& table, int file, char channel, std::size_t entry) {
  const auto m = [&](std::size_t row, std::size_t column) {
    return table.stored[9 * entry + 3 * row + column];
  };
  switch (file * 256 + channel) {
    case 0 * 256 + 'R':
      return m(0, 0);
    case 0 * 256 + 'G':
      return m(0, 1);
    case 0 * 256 + 'B':
      return m(0, 2);
    case 0 * 256 + 'A':
      return m(1, 0);
    case 1 * 256 + 'R':
      return m(1, 1);
    case 1 * 256 + 'G':
      return m(1, 2);
    case 1 * 256 + 'B':
      return m(2, 0);
    case 1 * 256 + 'A':
      return m(2, 1);
    case 2 * 256 + 'R':
      return m(2, 2);
    case 2 * 256 + 'G':
      return table.amplitude[entry];
    case 2 * 256 + 'B':
      return table.fresnel[entry];
    default:
      return 0;
  }
}

std::string ending(int file) {
  return "." + std::to_string(file) + ".exr";
}

// How many pixels differ from what they must be, in all channels of all files; `rounded` is applied
// to the expected values.
int wrong_pixels(const Table& table, const std::filesystem::path& prefix,
                 const std::function<float(float)>& rounded) {
  int wrong = 0;
  const auto [n_alpha, n_lambda, n_theta, n_phi] = table.grid.shape();
  for (int file = 0; file < 3; ++file) {
    for (const char channel : {'R', 'G', 'B', 'A'}) {
      const Image image =
          read_channel(prefix.string() + ending(file), std::string(1, channel).c_str());
      EXPECT_EQ(image.width, static_cast<int>(n_phi * n_lambda));
      EXPECT_EQ(image.height, static_cast<int>(n_theta * n_alpha));
      for (std::size_t a = 0; a < n_alpha; ++a)
        for (std::size_t l = 0; l < n_lambda; ++l)
          for (std::size_t t = 0; t < n_theta; ++t)
            for (std::size_t p = 0; p < n_phi; ++p)
              wrong += image.at(p + n_phi * l, t + n_theta * a) !=
                       rounded(expected_value(table, file, channel, table.grid.flat({a, l, t, p})));
    }
  }
  return wrong;
}

float as_is(float value) {
  return value;
}
float as_half(float value) {
  return ::half(value);
}

std::string refusal(const std::filesystem::path& prefix) {
  try {
    read_table(prefix.string() + ending(0));
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(Exr, OpenExrFindsEveryValueInItsTileAndChannel) {
  const TemporaryFolder folder;
  write_table(example(), folder / "t.0.exr");
  EXPECT_EQ(wrong_pixels(example(), folder / "t", as_is), 0);
  write_table(example(), folder / "h.0.exr", {true});
  EXPECT_EQ(wrong_pixels(example(), folder / "h", as_half), 0);
}

TEST(Exr, PixelCheckSeesATableLaidOutOtherwise) {
  const TemporaryFolder folder;
  write_table(example(), folder / "t.0.exr");
  Table other = example();
  other.stored[9 * 30 + 1] += 1;
  other.amplitude[31] += 1;
  EXPECT_EQ(wrong_pixels(other, folder / "t", as_is), 2);
  write_table(example(), folder / "h.0.exr", {true});
  EXPECT_GT(wrong_pixels(example(), folder / "h", as_is), 100);
}

TEST(Exr, PaperTableIsAnAtlasOf64Squared) {
  const TemporaryFolder folder;
  const Table table = testing::synthetic_table(Grid::paper(), Storage::matrix);
  write_table(table, folder / "t.0.exr");
  EXPECT_EQ(wrong_pixels(table, folder / "t", as_is), 0);
  EXPECT_EQ(read_channel(folder / "t.0.exr", "R").width, 64);
  EXPECT_EQ(read_channel(folder / "t.0.exr", "R").height, 64);
}

// Its exit code means nothing: exrinfo of OpenEXR 3.1 counts failures in a variable that it never
// sets to zero, and ends with any number in a quarter of its runs on sound files. What it finds
// wrong it prints as "ERROR".
std::string printed_by_exrinfo(const std::filesystem::path& file) {
  return testing::run("exrinfo -v " + file.string()).output;
}

TEST(Exr, ToolsShowSizeChannelsAndAttributes) {
  const TemporaryFolder folder;
  const Table table = testing::synthetic_table(Grid::paper(2), Storage::matrix);
  for (const bool half : {false, true}) {
    write_table(table, folder / "t.0.exr", {half});
    const Finished header = testing::run("exrheader " + (folder / "t.1.exr").string());
    ASSERT_EQ(header.exit_code, 0) << header.output;
    const std::string depth = half ? "16-bit floating-point" : "32-bit floating-point";
    for (const std::string& line :
         {std::string("dataWindow (type box2i): (0 0) - (3 3)"), "R, " + depth, "G, " + depth,
          "B, " + depth, "A, " + depth, std::string("ltc:format_version (type int): 1"),
          std::string("ltc:storage (type string): \"matrix\""),
          std::string("ltc:alpha_min (type double): 0.0001"),
          std::string("ltc:channels (type string): \"m11,m12,m20,m21\""),
          std::string("ltc:warp (type string): "
                      "\"{\"alpha\":\"linear\",\"lambda\":\"linear\",\"theta\":\"linear\","
                      "\"phi\":\"linear\"}\""),
          std::string("ltc:axes (type string): "
                      "\"{\"alpha\":[0.0,1.0],\"lambda\":[0.0,1.0],\"theta\":[0.0,1.570639")})
      EXPECT_NE(header.output.find(line), std::string::npos) << line << "\n" << header.output;
    const std::string info = printed_by_exrinfo(folder / "t.1.exr");
    EXPECT_NE(info.find("ltc:channels: string"), std::string::npos) << info;
    EXPECT_EQ(info.find("ERROR"), std::string::npos) << info;
  }
}

TEST(Exr, ExrinfoTellsOfAFileThatIsCutShort) {
  const TemporaryFolder folder;
  write_table(testing::synthetic_table(Grid::paper(2), Storage::matrix), folder / "t.0.exr");
  std::filesystem::resize_file(folder / "t.1.exr", 300);
  const std::string info = printed_by_exrinfo(folder / "t.1.exr");
  EXPECT_NE(info.find("ERROR"), std::string::npos) << info;
}

TEST(Exr, OurReaderGivesTheValuesBack) {
  const TemporaryFolder folder;
  const Table table = example();
  write_table(table, folder / "t.0.exr");
  const Table found = read_table(folder / "t.0.exr");
  EXPECT_EQ(found.grid, table.grid);
  EXPECT_EQ(found.storage, table.storage);
  testing::expect_same_bits(found.stored, table.stored, "stored");
  testing::expect_same_bits(found.amplitude, table.amplitude, "amplitude");
  testing::expect_same_bits(found.fresnel, table.fresnel, "fresnel");
  EXPECT_EQ(found.status, std::vector<Status>(table.grid.size(), Status::fitted));
  EXPECT_TRUE(std::isnan(found.sw_loss[0]));

  write_table(table, folder / "h.0.exr", {true});
  const Table half = read_table(folder / "h.0.exr");
  for (std::size_t i = 0; i < table.stored.size(); ++i)
    EXPECT_EQ(half.stored[i], as_half(table.stored[i]));
  EXPECT_EQ(found.precision, Precision::single);
  EXPECT_EQ(half.precision, Precision::half);
}

TEST(Exr, FoldedTablesHaveAFourthFile) {
  const TemporaryFolder folder;
  const Table table = testing::synthetic_table(testing::uneven_grid(), Storage::folded);
  write_table(table, folder / "t.0.exr");
  for (const char* name : {"t.0.exr", "t.3.exr"}) {
    const Table found = read_table(folder / name);
    testing::expect_same_bits(found.stored, table.stored, "stored");
    testing::expect_same_bits(found.fold, table.fold, "fold");
    EXPECT_EQ(found.creases, table.creases);
  }
  // Another table's, and none.
  Table other = table;
  other.creases = {0.5};
  write_table(other, folder / "o.0.exr");
  std::filesystem::copy_file(folder / "o.3.exr", folder / "t.3.exr",
                             std::filesystem::copy_options::overwrite_existing);
  EXPECT_THROW(read_table(folder / "t.0.exr"), InputError);
  std::filesystem::remove(folder / "t.3.exr");
  EXPECT_THROW(read_table(folder / "t.0.exr"), IoError);
  // Plain ones have three.
  write_table(example(), folder / "p.0.exr");
  EXPECT_FALSE(std::filesystem::exists(folder / "p.3.exr"));
}

TEST(Exr, WhetherATableIsRefinedIsKeptAndMayBeUnknown) {
  const TemporaryFolder folder;
  for (const std::optional<bool> refined : {std::optional<bool>(), {false}, {true}}) {
    Table table = example();
    table.refined = refined;
    write_table(table, folder / "t.0.exr");
    EXPECT_EQ(read_table(folder / "t.0.exr").refined, refined);
  }
}

TEST(Exr, TheSameTableGivesTheSameBytes) {
  const TemporaryFolder folder;
  write_table(example(), folder / "a.0.exr");
  ::sleep(1);  // a recorded time would show
  write_table(example(), folder / "b.0.exr");
  for (int file = 0; file < 3; ++file)
    EXPECT_EQ(bytes_of(folder / ("a" + ending(file))), bytes_of(folder / ("b" + ending(file))));
}

// By the definition, entry against entry; the program goes in waves.
std::size_t nearest_by_search(const Table& table, std::size_t entry) {
  const auto distance = [&table](std::size_t a, std::size_t b) {
    const NodeIndex m = table.grid.node(a), n = table.grid.node(b);
    const auto apart = [](std::size_t i, std::size_t j) { return i > j ? i - j : j - i; };
    return apart(m.alpha, n.alpha) + apart(m.lambda, n.lambda) + apart(m.theta, n.theta) +
           apart(m.phi, n.phi);
  };
  std::size_t best = table.grid.size();
  for (std::size_t i = 0; i < table.grid.size(); ++i)
    if (has_values(table.status[i]) &&
        (best == table.grid.size() || distance(entry, i) < distance(entry, best)))
      best = i;
  return best;
}

TEST(Exr, NearestFittedAgreesWithASearchOverAllEntries) {
  for (const std::size_t keep_every : {1, 2, 7, 23, 59, 119}) {
    Table table = example();
    for (std::size_t i = 0; i < table.grid.size(); ++i)
      if (i % keep_every != keep_every / 2)
        table.status[i] = i % 2 ? Status::skipped : Status::failed;
    const std::vector<std::size_t> found = nearest_fitted(table);
    for (std::size_t i = 0; i < table.grid.size(); ++i)
      EXPECT_EQ(found[i], nearest_by_search(table, i)) << i << " keep " << keep_every;
  }
}

TEST(Exr, SkippedAndFailedEntriesTakeTheNearestFitted) {
  const TemporaryFolder folder;
  Table table = example();
  for (const std::size_t entry : {40, 41, 42, 60, 119})
    skip(table, entry);
  table.status[42] = Status::failed;
  Table filled = table;
  for (const std::size_t entry : {40, 41, 42, 60, 119}) {
    const std::size_t source = nearest_by_search(table, entry);
    filled.set_stored(entry, table.stored_at(source));
    filled.amplitude[entry] = table.amplitude[source];
    filled.fresnel[entry] = table.fresnel[source];
  }
  write_table(table, folder / "t.0.exr");
  EXPECT_EQ(wrong_pixels(filled, folder / "t", as_is), 0);
}

TEST(Exr, WhatATextureCannotHoldIsRefusedAndNothingIsWritten) {
  const TemporaryFolder folder;
  Table all_skipped = example();
  for (std::size_t i = 0; i < all_skipped.grid.size(); ++i)
    skip(all_skipped, i);
  EXPECT_THROW(write_table(all_skipped, folder / "t.0.exr"), InputError);
  Table no_fresnel = example();
  no_fresnel.fresnel[5] = nan;
  EXPECT_THROW(write_table(no_fresnel, folder / "t.0.exr"), InputError);
  Table large = example();
  large.stored[100] = 70000;
  EXPECT_THROW(write_table(large, folder / "t.0.exr", {true}), InputError);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  EXPECT_NO_THROW(write_table(large, folder / "t.0.exr"));
  EXPECT_THROW(write_table(example(), folder / "none/t.0.exr"), IoError);
}

// A file of the example with something changed in its header; pixels are 0.5.
void write_variant(const std::filesystem::path& path, const std::filesystem::path& good,
                   const std::function<void(Imf::Header&)>& change, float pixel = 0.5f) {
  Imf::Header header = Imf::InputFile(good.c_str()).header();
  change(header);
  const auto& window = header.dataWindow();
  const std::vector<float> row(static_cast<std::size_t>(window.max.x - window.min.x + 1), pixel);
  Imf::FrameBuffer buffer;
  for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel)
    buffer.insert(channel.name(),
                  Imf::Slice(Imf::FLOAT,
                             reinterpret_cast<char*>(const_cast<float*>(row.data())) -
                                 window.min.x * static_cast<long>(sizeof(float)),
                             sizeof(float), 0));
  Imf::OutputFile file(path.c_str(), header);
  file.setFrameBuffer(buffer);
  file.writePixels(window.max.y - window.min.y + 1);
}

// The header without an attribute; Header::erase would leak it.
Imf::Header without_attribute(const Imf::Header& header, const std::string& name) {
  Imf::Header rest;
  for (auto attribute = header.begin(); attribute != header.end(); ++attribute)
    if (attribute.name() != name)
      rest.insert(attribute.name(), attribute.attribute());
  return rest;
}

TEST(Exr, HeadersThatDisagreeAreRefusedByFileAndFault) {
  const TemporaryFolder folder;
  write_table(example(), folder / "t.0.exr");
  const std::filesystem::path good = folder / "good.exr";
  std::filesystem::copy_file(folder / "t.1.exr", good);
  const auto text = [](const char* name, const std::string& value) {
    return [name, value](Imf::Header& header) {
      header = without_attribute(header, name);
      header.insert(name, Imf::StringAttribute(value));
    };
  };
  const auto without = [](const char* name) {
    return [name](Imf::Header& header) { header = without_attribute(header, name); };
  };
  const std::string axes = Imf::InputFile(good.c_str())
                               .header()
                               .typedAttribute<Imf::StringAttribute>("ltc:axes")
                               .value();
  nlohmann::json longer = nlohmann::json::parse(axes), nulls = longer, moved = longer;
  longer["phi"] = std::vector<double>(65, 0.1);
  nulls["phi"] = {0.0, nullptr};
  moved["alpha"] = {0.2, 0.5, 1.0};
  const std::map<std::string, std::function<void(Imf::Header&)>> variants = {
      {"ltc:format_version is missing", without("ltc:format_version")},
      {"ltc:format_version is 2; allowed: 1",
       [](Imf::Header& h) { h.insert("ltc:format_version", Imf::IntAttribute(2)); }},
      {"ltc:format_version is missing or not of type int", text("ltc:format_version", "1")},
      {"ltc:axes is missing", without("ltc:axes")},
      {"ltc:axes or ltc:warp: ", text("ltc:axes", "{\"alpha\":")},
      {"ltc:axes or ltc:warp: [", text("ltc:axes", nulls.dump())},
      {"axis phi: 65 nodes; allowed: 1 to 64", text("ltc:axes", longer.dump())},
      {"axis alpha: node 1 is 0.5; warp sqrt puts it at", text("ltc:axes", moved.dump())},
      {"ltc:warp is missing", without("ltc:warp")},
      {"ltc:axes or ltc:warp:", text("ltc:warp", "{}")},
      {"ltc:storage is missing", without("ltc:storage")},
      {"storage \"cholesky\" is unknown", text("ltc:storage", "cholesky")},
      {"alpha_min or ltc:refined differ from those of file 0", text("ltc:storage", "matrix")},
      {"ltc:alpha_min is missing", without("ltc:alpha_min")},
      {"ltc:refined is 2; allowed: 0 and 1",
       [](Imf::Header& h) { h.insert("ltc:refined", Imf::IntAttribute(2)); }},
      {"ltc:refined differ from those of file 0",
       [](Imf::Header& h) { h.insert("ltc:refined", Imf::IntAttribute(1)); }},
      {"ltc:channels is missing", without("ltc:channels")},
      {"ltc:channels is \"m00,m01,m02,m10\"", text("ltc:channels", "m00,m01,m02,m10")},
      {"channels must be R, G, B and A",
       [](Imf::Header& h) { h.channels().insert("Z", Imf::Channel(Imf::FLOAT)); }},
      {"the axes ask for 8 x 15 pixels", [](Imf::Header& h) { h.dataWindow().max.x = 15; }},
      {"data window is (-1, 0) to (6, 14)",
       [](Imf::Header& h) {
         h.dataWindow().min.x = -1;
         h.dataWindow().max.x = 6;
       }},
  };
  for (const auto& [fault, change] : variants) {
    write_variant(folder / "t.1.exr", good, change);
    const std::string message = refusal(folder / "t");
    EXPECT_NE(message.find(fault), std::string::npos) << fault << ": \"" << message << '"';
    EXPECT_TRUE(message.starts_with((folder / "t.1.exr").string())) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
  write_variant(
      folder / "t.1.exr", good, [](Imf::Header&) {}, nan);
  EXPECT_NE(refusal(folder / "t").find("channel R is not finite at pixel 0"), std::string::npos);
  write_variant(folder / "t.1.exr", good, [](Imf::Header&) {});
  EXPECT_EQ(refusal(folder / "t"), "") << "the unchanged variant is good";
}

TEST(Exr, DamagedBytesAreRefusedOrHarmless) {
  const TemporaryFolder folder;
  write_table(example(), folder / "t.0.exr");
  const std::string whole = bytes_of(folder / "t.2.exr");
  ASSERT_GT(whole.size(), 1000u);
  for (std::size_t size = 0; size < whole.size(); size += 13) {
    testing::write_bytes(folder / "t.2.exr", whole.substr(0, size));
    EXPECT_NE(refusal(folder / "t"), "") << size << " bytes";
  }
  int refused = 0;
  for (std::size_t i = 0; i < whole.size(); i += 3) {
    std::string flipped = whole;
    flipped[i] = static_cast<char>(flipped[i] ^ (1 << i % 8));
    testing::write_bytes(folder / "t.2.exr", flipped);
    refused += !refusal(folder / "t").empty();
  }
  EXPECT_GT(refused, 100);
}

TEST(Exr, AMissingFileIsAnIoErrorThatNamesIt) {
  const TemporaryFolder folder;
  write_table(example(), folder / "t.0.exr");
  std::filesystem::remove(folder / "t.2.exr");
  try {
    read_table(folder / "t.0.exr");
    FAIL();
  } catch (const IoError& error) {
    EXPECT_NE(std::string(error.what()).find("t.2.exr"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace ltc
