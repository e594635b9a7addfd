#pragma once

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <string>

namespace posefusion {

/// How a program ended and what it said.
struct ProgramRun {
  int exit_code = -1;
  std::string output;  ///< standard output and error
};

/// Runs a program as its users do, by a shell.
inline ProgramRun RunProgram(const std::string& program, const std::string& arguments) {
  const std::string command = program + " " + arguments + " 2>&1";
  std::FILE* pipe = popen(command.c_str(), "r");
  ProgramRun run;
  std::array<char, 256> buffer{};
  while (std::fgets(buffer.data(), buffer.size(), pipe) != nullptr) run.output += buffer.data();
  run.exit_code = WEXITSTATUS(pclose(pipe));
  return run;
}

}  // namespace posefusion
