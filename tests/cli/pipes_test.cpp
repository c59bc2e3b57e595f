// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Pipes and devices in place of files, through the real program.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include "support/generate_runs.h"
#include "support/refused_run.h"

namespace ltc::test {
namespace {

using namespace runs;

class Pipes : public ::testing::Test {
 protected:
  std::string make_pipe(const std::string& name) {
    const std::string path = (folder_ / name).string();
    EXPECT_EQ(::mkfifo(path.c_str(), 0600), 0);
    return path;
  }
  TemporaryDirectory folder_;
};

TEST_F(Pipes, ConfigsAreReadFromThem) {
  const std::string program = LTCFIT_PROGRAM;
  const std::string fit = program + " fit --entry 0,0,0,0 --samples 64 --json - --config ";
  const auto seed_with = [&](const std::string& shell) {
    const ProgramResult result = run_program({"bash", "-c", shell}, folder_.path());
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result.out.find("\"seed\": 7,") != std::string::npos;
  };
  EXPECT_TRUE(seed_with(fit + "<(echo fit.seed=7)"));
  EXPECT_TRUE(seed_with("echo fit.seed=7 | " + fit + "/dev/stdin"));
  // A writer that takes its time.
  EXPECT_TRUE(seed_with("(printf fit.; sleep 0.1; echo seed=7) | " + fit + "/dev/stdin"));
}

// A writer that writes nothing: opened once the program reads, which is when it can be interrupted.
TEST_F(Pipes, AnInterruptEndsTheWaitForTheWriter) {
  const std::string config = make_pipe("c.toml");
  const std::vector<std::pair<int, Arguments>> cases = {
      {SIGINT, {"generate", "--config", config}},
      {SIGTERM, {"generate", "--scene", config}},
      {SIGHUP, {"bench", "--config", config}},
      {SIGINT, {"stress", "--config", config}},
      {SIGTERM, {"fit", "--entry", "0,0,0,0", "--config", config}}};
  for (const auto& [signal, arguments] : cases) {
    SCOPED_TRACE(arguments[0] + " " + arguments[1]);
    RunningProgram program(command(arguments), folder_.path());
    int writer = -1;
    EXPECT_TRUE(program.wait_until(
        [&] { return (writer = ::open(config.c_str(), O_WRONLY | O_NONBLOCK)) >= 0; }, limit));
    program.send_signal(signal);
    expect_error(program.wait(limit), 130, {"interrupted; nothing was written"});
    ::close(writer);
  }
  EXPECT_EQ(names_in(folder_.path()), Arguments{"c.toml"});
}

TEST_F(Pipes, TablesAndScenesThatAreReadTwiceAreRefused) {
  const auto refused = [&](const Arguments& arguments, const Arguments& parts) {
    expect_error(run_ltcfit(arguments, folder_.path()), 3, parts);
  };
  for (const std::string name : {"t.h5", "t.npy", "t.0.exr"}) {
    const std::string pipe = make_pipe(name);
    refused({"validate", pipe}, {pipe, "no regular file"});
    refused({"diff", pipe, pipe}, {pipe, "no regular file"});
    refused({"render", pipe}, {pipe, "no regular file"});
    refused({"bench", "--reference", pipe}, {pipe, "no regular file"});
    refused({"fit", "--as-in", pipe, "--entry", "0,0,0,0"}, {pipe, "no regular file"});
    refused({"fit", "--start", "from=" + pipe, "--entry", "0,0,0,0"}, {pipe, "no regular file"});
  }
  refused({"generate", "--config", (folder_ / "t.h5").string()}, {"t.h5", "no regular file"});
  refused({"generate", "--extend", (folder_ / "t.h5").string()}, {"t.h5", "no regular file"});
  for (const std::string name : {"s.gltf", "s.glb", "s"}) {
    const std::string pipe = make_pipe(name);
    refused({"generate", "--scene", pipe}, {pipe, "it is a pipe"});
  }
  // An output that is one would wait for a reader.
  refused({"fit", "--entry", "0,0,0,0", "--json", make_pipe("j")}, {"cannot write", "a pipe"});
}

TEST_F(Pipes, DevicesWithoutAnEndAreTooLarge) {
  expect_error(run_ltcfit({"generate", "--config", "/dev/zero"}, folder_.path()), 2,
               {"/dev/zero", "larger than"});
  expect_error(run_ltcfit({"generate", "--output", "/dev/null"}, folder_.path()), 3,
               {"/dev/null", "is a file"});
}

}  // namespace
}  // namespace ltc::test
