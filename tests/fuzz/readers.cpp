// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "fuzz/readers.h"

#include <fstream>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <string>

#include "config/config.h"
#include "core/error.h"
#include "export/checkpoint.h"
#include "export/consistency.h"
#include "export/dds.h"
#include "export/hdf5.h"
#include "export/ktx2.h"
#include "export/number_text.h"
#include "export/octave.h"
#include "export/raw_image.h"
#include "export/table_file.h"
#include "scene/coverage.h"
#include "scene/readers.h"
#include "table/synthetic.h"

namespace ltc::fuzz {
namespace {

namespace fs = std::filesystem;

fs::path written(const fs::path& path, std::string_view bytes) {
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!file.flush())
    throw std::runtime_error("cannot write " + path.string());
  return path;
}

// What was read must be fit to work with: the same promise as for a file that we wrote.
void use(const Table& table, const fs::path& path) {
  try {
    require_consistent(table, path);
  } catch (const InputError& error) {
    throw std::logic_error(error.what());
  }
}

void use(const Scene& scene) {
  if (scene.materials.empty() ||
      needed_entries(scene, Grid::paper(3)).size() != Grid::paper(3).size())
    throw std::logic_error("a scene of nothing");
}

void read_h5_bytes(const fs::path& folder, std::string_view bytes) {
  const fs::path path = written(folder / "table.h5", bytes);
  use(read_table(path), path);
}

void read_npy_bytes(const fs::path& folder, std::string_view bytes) {
  const fs::path path = written(folder / "table.npy", bytes);
  use(read_table(path), path);
}

// A crash of the HDF5 library is a find here, for the guarded reader to be tried with.
void read_unguarded_h5_bytes(const fs::path& folder, std::string_view bytes) {
  const fs::path path = written(folder / "table.h5", bytes);
  use(read_hdf5_unguarded(path), path);
}

// The run that the checkpoints are of: two rounds of sixteen entries.
const Config& checkpointed_config() {
  static const std::vector<std::string> overrides = {"table.alpha.nodes=2", "table.lambda.nodes=2",
                                                     "table.theta.nodes=2", "table.phi.nodes=2",
                                                     "fit.gauss_newton.neighbour_sweeps=1"};
  static const Config config = load_config(std::nullopt, overrides);
  return config;
}

const std::vector<bool> checkpointed_entries(16, true);

template <auto read_as_checkpoint>
void read_checkpoint_bytes(const fs::path& folder, std::string_view bytes) {
  const fs::path path = written(folder / "checkpoint.h5", bytes);
  const FinishedFits fits =
      read_as_checkpoint(checkpointed_config(), checkpointed_entries, path, std::nullopt);
  if (fits.rounds.size() != 2 || fits.rounds[1].size() != checkpointed_entries.size())
    throw std::logic_error("a checkpoint of nothing");
}

// The bytes are the first of the three files; the others are those of a good table.
void read_exr_bytes(const fs::path& folder, std::string_view bytes) {
  const fs::path first = folder / "table.0.exr";
  if (!fs::exists(folder / "table.1.exr"))
    write_table(testing::synthetic_table(Grid::paper(2), Storage::matrix), first);
  written(first, bytes);
  use(read_table(first), first);
}

void read_config_bytes(const fs::path& folder, std::string_view bytes) {
  const Config config = load_config(written(folder / "config.toml", bytes), {});
  if (to_toml(config).empty())
    throw std::logic_error("a config of nothing");
}

void read_toml_scene_bytes(const fs::path& folder, std::string_view bytes) {
  use(load_toml_scene(written(folder / "scene.toml", bytes)));
}

// Text or binary: the first four bytes say which.
void read_gltf_bytes(const fs::path& folder, std::string_view bytes) {
  use(load_gltf_scene(written(folder / "scene.gltf", bytes)));
}

void use(const Image& image) {
  if (image.values.empty() || image.values.size() != image.texels() * image.channels)
    throw std::logic_error("an image of another size than it says");
}

template <auto decode>
void read_texture_bytes(const fs::path& folder, std::string_view bytes) {
  use(decode(bytes, folder / "texture"));
}

// JSON, Octave's or a program: the first byte says which.
void read_number_text(const fs::path& folder, std::string_view text) {
  const auto images = text.starts_with('{')    ? decode_json(text, folder / "numbers.json")
                      : text.starts_with("# ") ? decode_octave(text, folder / "numbers.mat")
                                               : decode_number_lists(text, folder / "numbers.js");
  if (images.empty())
    throw std::logic_error("a file of nothing");
  for (const Image& image : images)
    use(image);
}

// The description, a zero and the bytes, or bytes alone.
void read_raw(const fs::path& folder, std::string_view bytes) {
  const std::size_t end = bytes.starts_with('{') ? bytes.find('\0') : bytes.npos;
  const auto images = end == bytes.npos ? decode_bare(bytes, folder / "t.bin")
                                        : decode_raw(bytes.substr(end + 1), bytes.substr(0, end),
                                                     folder / "t.bin", folder / "t.bin.json");
  for (const Image& image : images)
    use(image);
}

}  // namespace

const Reader& unguarded_hdf5_reader() {
  static const Reader reader = {"unguarded_hdf5", read_unguarded_h5_bytes};
  return reader;
}

const Reader& checkpoint_reader() {
  static const Reader reader = {"checkpoint", read_checkpoint_bytes<read_checkpoint>};
  return reader;
}

const Reader& unguarded_checkpoint_reader() {
  static const Reader reader = {"unguarded_checkpoint",
                                read_checkpoint_bytes<read_checkpoint_unguarded>};
  return reader;
}

std::string good_checkpoint(const fs::path& folder) {
  FinishedFits fits;
  fits.rounds.assign(2, FitRound(checkpointed_entries.size()));
  write_checkpoint(checkpointed_config(), checkpointed_entries, fits, folder / "good.h5");
  std::ifstream file(folder / "good.h5", std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

const std::vector<Reader>& readers() {
  static const std::vector<Reader> all = {{"hdf5", read_h5_bytes},
                                          {"npy", read_npy_bytes},
                                          {"exr", read_exr_bytes},
                                          {"config", read_config_bytes},
                                          {"scene", read_toml_scene_bytes},
                                          {"gltf", read_gltf_bytes},
                                          {"dds", read_texture_bytes<decode_dds>},
                                          {"ktx2", read_texture_bytes<decode_ktx2>},
                                          {"text", read_number_text},
                                          {"raw", read_raw}};
  return all;
}

bool accepts(const Reader& reader, const fs::path& folder, std::string_view bytes) {
  try {
    reader.read(folder, bytes);
    return true;
  } catch (const InputError&) {
  } catch (const IoError&) {
  }
  return false;
}

}  // namespace ltc::fuzz
