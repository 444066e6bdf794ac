#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <system_error>

#include "lyrefit/base/file.h"
#include "lyrefit/base/new_file.h"
#include "lyrefit/base/number_text.h"
#include "lyrefit/base/try.h"
#include "lyrefit/report/figure_parts.h"

extern char** environ;

namespace lyrefit {
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

bool PutAtStart(const std::string& text, std::FILE* file) {
  const LimitIsAnError guard;
  return std::fwrite(text.data(), 1, text.size(), file) == text.size() && std::fflush(file) == 0 &&
         std::fseek(file, 0, SEEK_SET) == 0;
}

std::string ReadFromStart(std::FILE* file) {
  std::rewind(file);
  std::string text;
  std::array<char, 1 << 16> block;
  while (const std::size_t got = std::fread(block.data(), 1, block.size(), file)) {
    text.append(block.data(), got);
  }
  return text;
}

// The first line of gnuplot's error messages.
std::string FirstComplaint(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t\n\r^");
  if (begin == std::string::npos) return "no message";
  return text.substr(begin, text.find('\n', begin) - begin);
}

// Runs gnuplot with the three files as its standard streams. Returns its exit status, or -errno.
int RunWith(std::FILE* input, std::FILE* output, std::FILE* messages) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, fileno(input), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, fileno(output), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, fileno(messages), STDERR_FILENO);
  char program[] = "gnuplot";
  char no_startup_files[] = "-d";
  char* const arguments[] = {program, no_startup_files, nullptr};
  pid_t child = 0;
  // SIGXFSZ has its default action in the child, even if it is ignored here: a file-size limit ends
  // gnuplot, and half a picture is not used.
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t limit;
  sigemptyset(&limit);
  sigaddset(&limit, SIGXFSZ);
  posix_spawnattr_setsigdefault(&attributes, &limit);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
  const int failure = posix_spawnp(&child, program, &actions, &attributes, arguments, environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  if (failure != 0) return -failure;
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) return -errno;
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

// The terminal "svg", "png" or "pdf" by the extension.
Expected<std::string> TerminalFor(const std::string& path) {
  const std::string extension = LowerCase(std::filesystem::path(path).extension().string());
  if (extension == ".svg" || extension == ".png" || extension == ".pdf") return extension.substr(1);
  return Fail(fmt::format("expected a plot file that ends in .svg, .png or .pdf, found {}",
                          extension.empty() ? "no extension" : extension),
              path);
}

// Replaces the time in a PDF by one and the same, so that equal pictures are equal files.
void ForgetTheTime(std::string* picture) {
  constexpr char kTime[] = "/CreationDate (D:20000101000000";
  const std::size_t at = picture->find("/CreationDate (D:");
  if (at != std::string::npos) picture->replace(at, sizeof kTime - 1, kTime);
}

}  // namespace

Expected<std::string> RunGnuplot(const std::string& script) {
  // Files instead of pipes cannot block, and a gnuplot that dies raises no SIGPIPE.
  const File input(std::tmpfile());
  const File output(std::tmpfile());
  const File messages(std::tmpfile());
  if (!input || !output || !messages) return Fail("cannot create a temporary file for gnuplot");
  if (!PutAtStart(script, input.get())) {
    return Fail("cannot write the temporary file for gnuplot: " +
                std::generic_category().message(errno));
  }
  const int status = RunWith(input.get(), output.get(), messages.get());
  if (status == -ENOENT || status == 127) {
    return Fail("plots need gnuplot, which was not found: install it (Debian: gnuplot-nox)");
  }
  if (status < 0) {
    return Fail("cannot start gnuplot: " + std::generic_category().message(-status));
  }
  if (status == 128 + SIGXFSZ) {
    return Fail("cannot write the picture: " + std::generic_category().message(EFBIG));
  }
  std::string picture = ReadFromStart(output.get());
  if (status != 0 || picture.empty()) {
    return Fail(fmt::format("gnuplot could not draw the plot: {}",
                            FirstComplaint(ReadFromStart(messages.get()))));
  }
  return picture;
}

Expected<void> DrawFigure(const Figure& figure, const std::string& path, PlotPoints points) {
  TRY(const std::string terminal, TerminalFor(path));
  Expected<std::string> picture = RunGnuplot(FigureScript(figure, terminal, points));
  if (!picture) return Fail(picture.error().message, path);
  if (terminal == "pdf") ForgetTheTime(&*picture);
  return WriteTextFile(path, *picture);
}

Expected<void> CheckPlot(const std::string& path) {
  TRY(const std::string terminal, TerminalFor(path));
  const Expected<std::string> answer = RunGnuplot("set print '-'; print GPVAL_TERMINALS\n");
  if (!answer) return Fail(answer.error().message, path);
  if (terminal == "svg" || answer->find(terminal + "cairo") != std::string::npos) return {};
  return Fail(
      fmt::format("a .{} needs a gnuplot with {}cairo (Debian: gnuplot-nox); a .svg does not",
                  terminal, terminal),
      path);
}

}  // namespace lyrefit
