#pragma once

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

namespace posefusion {

constexpr int kExitFailure = 1;  ///< the work failed
constexpr int kExitUsage = 2;    ///< the arguments cannot be used

/// The main of a program: reads the arguments that are bound to `app`, then calls `run`, which
/// gives the exit code. Exceptions are told on the terminal behind the program's name.
template <class Run>
int RunTool(CLI::App& app, int argc, char** argv, const char* name, const Run& run) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kExitUsage;
  }
  try {
    return run();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", name, error.what());
    return kExitFailure;
  }
}

}  // namespace posefusion
