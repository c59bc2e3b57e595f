// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The formats of table files, each in a file of its own, and the list of them. All that reads,
// writes or names tables' files asks the list.
#pragma once

#include <filesystem>
#include <functional>
#include <list>
#include <optional>
#include <string>
#include <vector>

#include "config/config.h"
#include "core/platform.h"
#include "export/texture_layout.h"
#include "table/table.h"

namespace ltc {

// What a format holds beside axes and matrices.
struct TableContents {
  bool albedo = true;  // amplitude and Fresnel
  bool loss = true;    // and what else is known of the fits, with the config that made them
};

struct WriteOptions {
  bool half = false;                                // 16-bit values, where the format has them
  TextureLayout layout = TextureLayout::automatic;  // of formats that are textures
  bool zstd = true;
  ScriptStyle javascript_style = ScriptStyle::arrays;
};

// What a file does not say of itself, or is not asked for.
struct ReadAs {
  std::optional<Layout> axes;  // of arrays without axes; else told apart
  TextureLayout textures = TextureLayout::automatic;
  const LobeModel* model = nullptr;  // the BRDF; null: GGX
};

// The files of one table, in the order of the format's endings.
using TableFiles = std::vector<std::filesystem::path>;

struct Format {
  std::string name;  // as users know it: "NPY"
  // What the names of the files end in, one a file of the set: ".0.exr", ".1.exr", ".2.exr".
  // Formats of textures have several such sets, the one that all their names end in last.
  std::vector<std::vector<std::string>> sets;
  bool OutputSettings::*asked = nullptr;  // the key of [output] that asks for it; null: none does
  TableContents contents = {};
  std::size_t entry_bytes = 0;  // of an entry, uncompressed, in values of 32 bits
  // The key that asks for 16-bit values; null: it has none.
  bool OutputSettings::*half = nullptr;
  bool of_fields = false;     // whether it holds fields alone
  bool of_materials = false;  // whether it holds fields of one material
  bool of_folded = false;     // whether it holds folded lobes; the others know of no fold
  bool of_one_pair = false;   // and of these only those with one pair of creases
  bool without_axes = false;  // whether a reader is to be told the layout of the grid
  // Whether others use such names for files of their own, so that none is removed as an older one
  // of the set.
  bool ending_of_others = false;
  // Sets that are called as others call them: read, and written by the layouts that are theirs.
  std::vector<std::vector<std::string>> named_sets = {};
  // The set of folded tables, where it is another one.
  std::vector<std::string> folded_set = {};
  // Which of these sets is written; null: the first of `sets`.
  std::function<std::vector<std::string>(TextureLayout layout)> set_for = {};
  // Why it cannot hold tables of this grid, storage and layout, after "it"; empty where it can.
  // Null: it holds all.
  std::function<std::string(const Grid& grid, Storage storage, TextureLayout layout)> limits = {};
  // Throws IoError for a file that cannot be opened; InputError, naming file and fault, for one
  // that is none of the format or damaged, or disagrees with the others of the set.
  std::function<Table(const TableFiles& files, const ReadAs& as)> read = {};
  // Adds the files to those that take their places with set.commit(); the same table gives the same
  // bytes. The table is consistent (export/consistency.h) and one that the format can hold. Null:
  // it is only read.
  std::function<void(platform::FileSet& set, const Table& table, const TableFiles& files,
                     const WriteOptions& options)>
      add = {};

  // Those that are written of tables of such a grid and storage.
  TableFiles files(const std::filesystem::path& prefix, const Grid& grid, Storage storage,
                   TextureLayout layout) const;
  // Those that any layout writes under names of ours.
  TableFiles all_files(const std::filesystem::path& prefix) const;
  // The same for any format: one that names its axes calls them alpha and lambda.
  std::string why_not(const Grid& grid, Storage storage, TextureLayout layout) const;
  // Whether the config asks for it, a format of fields with a field; and whether it can hold the
  // config's table too.
  bool is_asked(const Config& config) const {
    return asked && config.output.*asked && (!of_fields || config.field.size > 0);
  }
  bool is_written(const Config& config) const {
    return is_asked(config) && (of_folded || config.storage != Storage::folded) &&
           !(of_one_pair && config.storage == Storage::folded && config.field.creases.size() > 1) &&
           why_not(config.grid, config.storage, config.output.layout).empty();
  }
};

// In the order in which files are written and named.
const std::list<Format>& formats();

// One more format for as long as this lives. Not while tables are read or written.
class AddedFormat {
 public:
  explicit AddedFormat(Format format);
  ~AddedFormat();
  AddedFormat(const AddedFormat&) = delete;
  AddedFormat& operator=(const AddedFormat&) = delete;

 private:
  std::list<Format>::iterator place_;
};

// Whether a format keeps all that is known of the fits, with the config that made them.
inline bool keeps_fits(const Format& format) {
  return format.contents.loss;
}

// Whether files of a format can be read, which of functions in a language they cannot.
inline bool is_read(const Format& format) {
  return static_cast<bool>(format.read);
}

// The format of a file of such a name; null where none has its ending.
const Format* find_format(const std::filesystem::path& file);

// The set of files that one of such a name belongs to, and what they have in common: "out/ltc" of
// "out/ltc.1.exr".
struct NamedSet {
  const Format* format = nullptr;  // null where no format has its ending
  std::filesystem::path prefix;
  TableFiles files;
};
NamedSet set_of(const std::filesystem::path& file);

// The set to write to a file of such a name: where two formats share an ending, as arrays and
// functions in C do, the one of functions if so asked.
NamedSet set_to_write(const std::filesystem::path& file, bool functions);

// What the options of [output] are to a format.
WriteOptions write_options(const Format& format, const OutputSettings& output);

// ".h5, .0.exr or .npy": what a file's name ends in, of all formats that `which` takes.
std::string endings_text(const std::function<bool(const Format&)>& which = [](const Format&) {
  return true;
});

}  // namespace ltc
