// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The page of `ltcfit view` as a file: what it holds, and what is refused. browser_test.cpp opens
// it.
#include <gtest/gtest.h>

#include <regex>

#include "brdf/separable_ggx.h"
#include "core/error.h"
#include "export/table_file.h"
#include "field/synthetic_field.h"
#include "report/viewer_files.h"
#include "report/viewer_page.h"
#include "support/program.h"
#include "support/refusal.h"
#include "table/field_table.h"
#include "table/synthetic.h"

namespace ltc::test {
namespace {

Table small_table() {
  return testing::synthetic_table(Grid::paper(2), Storage::matrix);
}

std::string page_of(const Table& table, const std::string& name = "t.h5") {
  const ViewedTable viewed{name, &table};
  return viewer_page({&viewed, 1});
}

nlohmann::json data_of(const std::string& page) {
  const std::string begin = "<script type=\"application/json\" id=\"data\">";
  const std::size_t at = page.find(begin) + begin.size();
  return nlohmann::json::parse(page.substr(at, page.find("</script>", at) - at));
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size())
    ++found;
  return found;
}

TEST(ViewerPage, StandsByItself) {
  const std::string page = page_of(small_table());
  for (const char* outside :
       {"http://", "https://", "src=", "@import", "url(", "import ", " fetch("})
    EXPECT_EQ(page.find(outside), std::string::npos) << outside;
  for (const char* mark : {"@TITLE@", "@DATA@", "/*STYLE*/", "/*SCRIPT*/", "<!--VALUES-->"})
    EXPECT_EQ(page.find(mark), std::string::npos) << mark;
  EXPECT_EQ(count(page, "<script"), 4u);
  EXPECT_EQ(count(page, "</script"), 4u);
}

TEST(ViewerPage, IsTheSameBytesForTheSameTable) {
  EXPECT_EQ(page_of(small_table()), page_of(small_table()));
}

TEST(ViewerPage, TellsTheTablesApart) {
  const Table nodes = testing::synthetic_table(testing::uneven_grid(), Storage::mirror_frame);
  const Table field =
      table_of_field(testing::synthetic_field(), Grid::paper(2), Storage::matrix, {1, nullptr});
  const std::vector<ViewedTable> both{{"a.h5", &nodes}, {"b.json", &field}};
  const std::string page = viewer_page(both);
  const nlohmann::json tables = data_of(page)["tables"];
  ASSERT_EQ(tables.size(), 2u);
  EXPECT_EQ(tables[0]["size"], nlohmann::json(nodes.grid.shape()));
  EXPECT_EQ(tables[0]["storage_name"], "mirror-frame");
  EXPECT_EQ(tables[0]["half"], false);
  // Three texels of four floats an entry, in base64.
  EXPECT_EQ(tables[0]["length"], (nodes.grid.size() * 48 + 2) / 3 * 4);
  EXPECT_FALSE(tables[0].contains("field"));
  EXPECT_EQ(tables[1]["numbers"], field.field->terms.size());
  EXPECT_NE(tables[1]["field"].get<std::string>().find("void ltcLookUp("), std::string::npos);
  EXPECT_NE(page.find("id=\"values-0\""), std::string::npos);
  EXPECT_EQ(page.find("id=\"values-1\""), std::string::npos);
}

TEST(ViewerPage, KeepsSixteenBitsWhereNothingIsLost) {
  Table table = small_table();
  for (std::vector<float>* values : {&table.stored, &table.amplitude, &table.fresnel})
    for (float& value : *values)
      value = rounded(value, Precision::half);
  table.precision = Precision::half;
  EXPECT_EQ(data_of(page_of(table))["tables"][0]["half"], true);
  table.amplitude[0] = 0.1f;
  EXPECT_EQ(data_of(page_of(table))["tables"][0]["half"], false);
}

TEST(ViewerPage, NamesAreTextAlone) {
  const std::string page = page_of(small_table(), "</script><b>&\xff.h5");
  EXPECT_EQ(count(page, "</script"), 4u);
  EXPECT_EQ(page.find("<b>&"), std::string::npos);
  EXPECT_NE(page.find("<title>&lt;/script&gt;&lt;b&gt;&amp;\uFFFD.h5"), std::string::npos);
}

TEST(ViewerPage, CountsWhatIsMissing) {
  Table table = small_table();
  table.status[3] = Status::skipped;
  EXPECT_EQ(data_of(page_of(table))["tables"][0]["missing"], 1);
  std::ranges::fill(table.status, Status::skipped);
  EXPECT_THROW(page_of(table), InputError);
}

TEST(ViewerPage, IsOfGgxAndOfOneTableOrTwo) {
  Table other = small_table();
  other.grid.model = &separable_ggx();
  EXPECT_NE(
      message_of<InputError>([&] { page_of(other, "o.h5"); }).find("o.h5: a table of the BRDF"),
      std::string::npos);
  EXPECT_NE(
      message_of<InputError>([] { viewer_page({}); }).find("0 tables to view; expected 1 or 2"),
      std::string::npos);
  EXPECT_THROW(viewer_file("none.js"), InputError);
}

class View : public ::testing::Test {
 protected:
  View() { write_table(small_table(), folder_ / "t.h5"); }
  ProgramResult run(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "view");
    return run_ltcfit(arguments, folder_.path());
  }
  TemporaryDirectory folder_;
};

TEST_F(View, WritesThePage) {
  const ProgramResult result = run({"t.h5"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out.substr(0, 19), "wrote viewer.html, ");
  EXPECT_EQ(count(result.out, "\n"), 1u);
  EXPECT_EQ(names_in(folder_.path()), (std::vector<std::string>{"t.h5", "viewer.html"}));
  EXPECT_EQ(run({"t.h5", "t.h5", "-o", "two.html"}).exit_code, 0);
  EXPECT_EQ(data_of(read_file(folder_ / "two.html"))["tables"].size(), 2u);
}

// Matrices alone have no amplitude: the page would be black.
TEST_F(View, IntegratesWhatAFileLacks) {
  write_table(small_table(), folder_ / "t.npy");
  ASSERT_EQ(run({"t.npy", "--layout", "alpha-lambda"}).exit_code, 0);
  EXPECT_EQ(data_of(read_file(folder_ / "viewer.html"))["tables"][0]["missing"], 0);
}

TEST_F(View, RefusesWhatItCannotReadOrWrite) {
  const std::string table = read_file(folder_ / "t.h5");
  folder_.write("cut.h5", table.substr(0, table.size() / 2));
  for (const auto& [arguments, code, part] :
       {std::tuple<std::vector<std::string>, int, const char*>({"t.h5", "-o", "t.h5"}, 2,
                                                               "expected a file that ends in .html"),
        {{"t.h5", "-o", "none/x.html"}, 3, "no folder none"},
        {{"t.h5", "-o", ""}, 2, "expected a file"},
        {{"none.h5"}, 3, "none.h5"},
        {{"t.h5", "none.h5"}, 3, "none.h5"},
        {{"cut.h5"}, 2, "cut.h5"},
        {{}, 2, "TABLE is missing"}}) {
    const ProgramResult result = run(arguments);
    EXPECT_EQ(result.exit_code, code) << result.err;
    EXPECT_NE(result.err.find(part), std::string::npos) << result.err;
    EXPECT_EQ(count(result.err, "\n"), 1u) << result.err;
  }
  EXPECT_EQ(names_in(folder_.path()), (std::vector<std::string>{"cut.h5", "t.h5"}));
  EXPECT_EQ(read_file(folder_ / "t.h5"), table);
}

}  // namespace
}  // namespace ltc::test
