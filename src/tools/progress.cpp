#include "tools/progress.h"

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <utility>

namespace posefusion {
namespace {

constexpr std::chrono::milliseconds kTerminalPeriod(200);
constexpr std::chrono::seconds kPlainPeriod(5);
constexpr double kMinElapsedS = 0.5;  // before that the rate says nothing
constexpr const char* kEraseLine = "\r\033[K";

}  // namespace

Progress::Progress(std::string title, std::optional<int> total, std::string unit)
    : title_(std::move(title)),
      total_(total),
      unit_(std::move(unit)),
      is_terminal_(isatty(STDERR_FILENO) != 0),
      start_(std::chrono::steady_clock::now()),
      last_shown_(start_) {}

Progress::~Progress() { Finish(); }

void Progress::Update(int done) {
  done_ = done;
  const auto now = std::chrono::steady_clock::now();
  const bool due =
      is_terminal_ ? now - last_shown_ >= kTerminalPeriod : now - last_shown_ >= kPlainPeriod;
  if (finished_ || !due) return;
  last_shown_ = now;
  Show();
}

void Progress::Finish() {
  if (finished_) return;
  finished_ = true;
  Show();
  if (is_terminal_) std::fputc('\n', stderr);
}

void Progress::Print(const std::string& text) {
  std::fprintf(stderr, "%s%s\n", is_terminal_ ? kEraseLine : "", text.c_str());
  if (is_terminal_ && !finished_) Show();
}

void Progress::Show() {
  using Seconds = std::chrono::duration<double>;
  const double elapsed_s = Seconds(std::chrono::steady_clock::now() - start_).count();
  const std::string text = ProgressText(title_, done_, total_, unit_, elapsed_s);
  std::fprintf(stderr, is_terminal_ ? "\r\033[K%s" : "%s\n", text.c_str());
  std::fflush(stderr);
}

std::string ProgressText(const std::string& title, int done, std::optional<int> total,
                         const std::string& unit, double elapsed_s) {
  std::string text = title + ": " + std::to_string(done);
  if (total) text += " / " + std::to_string(*total);
  text += " " + unit;
  char part[64];
  if (total && *total > 0) {
    std::snprintf(part, sizeof part, " (%d %%)", static_cast<int>(100LL * done / *total));
    text += part;
  }
  if (done == 0 || elapsed_s < kMinElapsedS) return text;
  const double rate = done / elapsed_s;
  std::snprintf(part, sizeof part, ", %.1f/s", rate);
  text += part;
  if (total && done < *total) text += ", " + DurationText((*total - done) / rate) + " left";
  return text;
}

std::string DurationText(double seconds) {
  const auto whole = static_cast<long long>(std::llround(seconds));
  const int second = static_cast<int>(whole % 60);
  const int minute = static_cast<int>(whole / 60 % 60);
  char text[48];
  if (whole < 60) {
    std::snprintf(text, sizeof text, "%d s", second);
  } else if (whole < 3600) {
    std::snprintf(text, sizeof text, "%d:%02d min", minute, second);
  } else {
    std::snprintf(text, sizeof text, "%lld:%02d:%02d h", whole / 3600, minute, second);
  }
  return text;
}

}  // namespace posefusion
