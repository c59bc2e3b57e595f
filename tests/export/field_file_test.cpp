// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Fields in JSON and HDF5: read back as written; what is refused, and in which words.
#include "export/field_file.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "core/error.h"
#include "export/table_file.h"
#include "field/synthetic_field.h"
#include "support/refusal.h"
#include "support/temporary_directory.h"
#include "table/field_table.h"

namespace ltc {
namespace {

using Json = nlohmann::ordered_json;
using testing::synthetic_field;

Table field_table() {
  Table table = table_of_field(synthetic_field(), Grid::paper(3), Storage::matrix);
  table.config = "a = 1\n";
  table.generator = "ltcfit test";
  table.seed = 7;
  return table;
}

Json good() {
  return Json::parse(encode_field(field_table()));
}

void expect_refusal(const std::function<void()>& action, const std::vector<std::string>& parts) {
  test::expect_one_line(test::message_of<InputError>(action), parts);
}

void expect_refused(const Json& json, const std::string& words) {
  expect_refusal([&] { decode_field(json.dump(), "x.json"); }, {"x.json", words});
}

TEST(FieldFile, JsonIsReadBackAsWritten) {
  const test::TemporaryDirectory folder;
  write_table(field_table(), folder / "t_field.json", {});
  std::filesystem::copy_file(folder / "t_field.json", folder / "t.json");
  // Under its own name, and as any JSON.
  for (const char* name : {"t_field.json", "t.json"}) {
    const Table read = read_table(folder / name, {});
    EXPECT_EQ(read.field, field_table().field);
    EXPECT_EQ(read.config, "a = 1\n");
    EXPECT_EQ(read.seed, 7u);
    EXPECT_EQ(read.grid, Grid::paper());
  }
}

Field folded_field() {
  Field field = synthetic_field();
  field.creases = {0.3, 1};
  field.terms.push_back({FieldPart::kappa, 0, 1, 0, 0, 1});
  field.terms.push_back({FieldPart::gamma, 0, 1, 0, 0, 0});
  field.coefficients.insert(field.coefficients.end(), {-0.8f, 0.25f});
  return field;
}

TEST(FieldFile, FoldedOnesAreReadBack) {
  const test::TemporaryDirectory folder;
  const Table table = table_of_field(folded_field(), Grid::paper(3), Storage::matrix);
  EXPECT_EQ(table.storage, Storage::folded);
  for (const char* name : {"t_field.json", "t.h5"}) {
    write_table(table, folder / name, {});
    const Table back = read_table(folder / name);
    EXPECT_EQ(back.field, folded_field()) << name;
    EXPECT_EQ(back.creases, table.creases) << name;
  }
  for (const char* name : {"t.npy", "t.dds"})
    expect_refusal([&] { write_table(table, folder / name, {}); }, {"cannot hold"});
}

TEST(FieldFile, CreasesAreIncreasingNumbers) {
  Json json =
      Json::parse(encode_field(table_of_field(folded_field(), Grid::paper(3), Storage::matrix)));
  for (const Json& creases : {Json::array(), Json{0.4, 0.4}, Json{-1}, Json{"a"}, Json(0.4)}) {
    json["creases"] = creases;
    expect_refused(json, "creases are");
  }
  // Without creases there is no fold, and another basis, which older readers know.
  json.erase("creases");
  expect_refused(json, "basis is \"chebyshev-polar-folded\"; allowed: \"chebyshev-polar\"");
  json["basis"] = "chebyshev-polar";
  EXPECT_EQ(decode_field(json.dump(), "x.json").field->terms.size(),
            synthetic_field().terms.size());
}

TEST(FieldFile, Hdf5HasTheFieldBesideTheNodes) {
  const test::TemporaryDirectory folder;
  write_table(field_table(), folder / "t.h5", {});
  const Table read = read_table(folder / "t.h5", {});
  EXPECT_EQ(read.field, field_table().field);
  EXPECT_EQ(read.stored, field_table().stored);
}

TEST(FieldFile, RefusesWhatIsNoField) {
  Json json = good();
  json["format_version"] = 2;
  expect_refused(json, "format_version is 2; allowed: 1");
  json = good();
  json["basis"] = "wavelets";
  expect_refused(json, "basis is \"wavelets\"; allowed: \"chebyshev-polar\"");
  json = good();
  json["brdf"] = "velvet";
  expect_refused(json, "velvet");
  json = good();
  json["alpha_min"] = 0;
  expect_refused(json, "alpha_min is 0; allowed: 1e-06 to 1");
  json = good();
  json["parts"]["A"]["coefficients"][0] = 1e6;
  expect_refused(json, "its coefficient is 1000000; allowed: up to 65504");
  json = good();
  json["material"] = {0.1, 0.4};
  expect_refused(json, "material is [0.1,0.4]; allowed: the larger and the smaller");
  json = good();
  json["parts"].erase("m12");
  expect_refused(json, "\"parts\" has no \"m12\"");
  json = good();
  json["parts"]["A"]["coefficients"].push_back(1);
  expect_refused(json, "A has 2 terms and 3 coefficients");
  json = good();
  json["parts"]["A"]["coefficients"][0] = "NaN";
  expect_refused(json, "coefficient 0 of A is \"NaN\"");
  json = good();
  json["parts"]["A"]["coefficients"][0] = 1e300;
  expect_refused(json, "coefficient 0 of A");
  json = good();
  json["parts"]["A"]["terms"][0] = {0, 0, 0, 0};
  expect_refused(json, "five whole numbers up to 20");
  json = good();
  json["parts"]["A"]["terms"][0] = {0, 0, 0, 0, 99};
  expect_refused(json, "five whole numbers up to 20");
  json = good();
  json["parts"]["A"]["terms"][0] = {0, 1, 0, 0, 0};
  expect_refused(json, "symmetry does not allow it");
  json = good();
  json["parts"]["A"]["terms"][1] = json["parts"]["A"]["terms"][0];
  expect_refused(json, "stands twice");
  expect_refusal([] { decode_field("{\"format\": \"ltc-field\"", "x.json"); }, {"no JSON object"});
}

TEST(FieldFile, OfOneMaterialIsReadBackAndGoesIntoNoTable) {
  Field field = synthetic_field();
  field.material = {0.4, 0.1};
  const Table table = table_of_field(field, Grid::paper(3), Storage::matrix);
  EXPECT_EQ(decode_field(encode_field(table), "x.json").field, field);
  const test::TemporaryDirectory folder;
  expect_refusal([&] { write_table(table, folder / "t.h5", {}); }, {"one of one"});
}

TEST(FieldFile, ACommentCannotBeEnded) {
  Table table = field_table();
  table.generator = "*/ int x; /*";
  const test::TemporaryDirectory folder;
  platform::FileSet set;
  add_table(set, table, *set_to_write("t.h", true).format, folder / "t", {});
  set.commit();
  EXPECT_NE(test::read_file(folder / "t.h").find("by * / int x; /*."), std::string::npos);
}

TEST(FieldFile, OfTablesOfNodesThereIsNone) {
  Table table = field_table();
  table.field.reset();
  const test::TemporaryDirectory folder;
  expect_refusal([&] { write_table(table, folder / "t_field.json", {}); }, {"holds fields"});
  expect_refusal([&] { write_table(table, folder / "t.mjs", {}); }, {"holds fields"});
}

}  // namespace
}  // namespace ltc
