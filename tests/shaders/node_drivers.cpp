// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// WebGPU by the npm package webgpu and WebGL 2 by headless Chromium: a folder goes to a script of
// Node.js, which puts the answers beside.
#include <cstring>
#include <nlohmann/json.hpp>

#include "shaders/job.h"
#include "support/program.h"
#include "test_paths.h"

namespace ltc::test::shaders {
namespace {

std::string bytes_of(const std::vector<float>& values) {
  std::string bytes(4 * values.size(), '\0');
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

void write_job(const Job& job, const TemporaryDirectory& folder) {
  nlohmann::json description = {{"count", job.count()}, {"textures", nlohmann::json::array()}};
  for (const Texture& texture : job.textures) {
    description["textures"].push_back({{"name", texture.name},
                                       {"width", texture.width},
                                       {"height", texture.height},
                                       {"depth", texture.depth},
                                       {"levels", texture.levels}});
    folder.write(texture.name + ".bin", bytes_of(texture.values));
  }
  folder.write("job.json", description.dump());
  folder.write("input.bin", bytes_of(job.input));
  folder.write("cases.wgsl", job.wgsl);
  folder.write("cases.frag", fragment_of(job));
}

// Exit code 77: the machine lacks what the last line of standard error names.
Results run_script(const Job& job, const std::string& script) {
  const TemporaryDirectory folder;
  write_job(job, folder);
  const ProgramResult result =
      run_program({"node", LTCFIT_SOURCE_DIR "/tests/shaders/" + script, folder.path().string()});
  if (result.exit_code == 127)
    throw Missing("no node");
  if (result.exit_code == 77)
    throw Missing(result.err);
  if (result.exit_code != 0)
    throw std::runtime_error(result.err);
  const std::string bytes = read_file(folder / "output.bin");
  Results results(bytes.size() / 4);
  std::memcpy(results.data(), bytes.data(), bytes.size());
  return results;
}

}  // namespace

Results run_webgpu(const Job& job) {
  return run_script(job, "webgpu.mjs");
}
Results run_webgl(const Job& job) {
  return run_script(job, "webgl.mjs");
}

}  // namespace ltc::test::shaders
