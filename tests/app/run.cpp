// SPDX-License-Identifier: Apache-2.0
#include "app/run.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <thread>

namespace {

namespace fs = std::filesystem;

std::string contents(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void limit(decltype(RLIMIT_FSIZE) what, long bytes) {
  if (bytes < 0) return;
  const rlimit value{rlim_t(bytes), rlim_t(bytes)};
  setrlimit(what, &value);
}

void redirect(const std::string& file, int descriptor) {
  const int opened = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (opened < 0 || dup2(opened, descriptor) < 0) _exit(127);
}

/// Becomes the program; never returns.
[[noreturn]] void become(const std::vector<std::string>& arguments, const Setup& setup,
                         const std::string& out, const std::string& err) {
  redirect("/dev/null", STDOUT_FILENO);
  const int input = open("/dev/null", O_RDONLY);
  dup2(input, STDIN_FILENO);
  redirect(out, STDOUT_FILENO);
  redirect(err, STDERR_FILENO);
  if (!setup.folder.empty() && chdir(setup.folder.c_str()) != 0) _exit(127);
  for (const auto& [name, value] : setup.variables) setenv(name.c_str(), value.c_str(), 1);
  limit(RLIMIT_FSIZE, setup.fileSizeLimit);
  limit(RLIMIT_AS, setup.memoryLimit);
  std::vector<char*> words = {const_cast<char*>(setup.program.c_str())};
  for (const std::string& a : arguments) words.push_back(const_cast<char*>(a.c_str()));
  words.push_back(nullptr);
  execv(setup.program.c_str(), words.data());
  _exit(127);
}

double now() {
  using namespace std::chrono;
  return duration<double>(steady_clock::now().time_since_epoch()).count();
}

}  // namespace

Run runVestige(const std::vector<std::string>& arguments, const Setup& given) {
  const Folder own;
  Setup setup = given;
  if (setup.folder.empty()) setup.folder = own.path();
  const std::string out = own / "stdout", err = own / "stderr";
  const double start = now();
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("cannot start a process");
  if (child == 0) become(arguments, setup, out, err);
  bool interrupted = setup.interruptAt.empty(), hung = false;
  int status = 0;
  while (waitpid(child, &status, WNOHANG) == 0) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    if (!interrupted && contents(out).find(setup.interruptAt) != std::string::npos) {
      kill(child, setup.interruptSignal);
      interrupted = true;
    }
    if (!hung && now() - start > setup.patience) {
      kill(child, SIGKILL);
      hung = true;
    }
  }
  const int exit = hung ? kHung : WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  return {exit, contents(out), contents(err), now() - start};
}

Folder::Folder() {
  std::string name = (fs::temp_directory_path() / "vestige-test-XXXXXX").string();
  if (!mkdtemp(name.data())) throw std::runtime_error("cannot make a temporary folder");
  path_ = name;
}

Folder::~Folder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::string Folder::write(const std::string& name, const std::string& text) const {
  std::ofstream(path_ / name, std::ios::binary) << text;
  return (path_ / name).string();
}

std::vector<std::string> Folder::names() const {
  std::vector<std::string> found;
  for (const auto& entry : fs::directory_iterator(path_))
    found.push_back(entry.path().filename().string());
  return found;
}

std::string smallScene(const std::string& more) {
  return "camera pinhole { location <0, 1.5, -5> look_at <0, 1, 0> angle 45 }\n"
         "film { resolution <16, 16> }\n"
         "light area { <-1, 4, -1>, <2, 0, 0>, <0, 0, 2> radiance rgb 10 }\n"
         "plane { <0, 1, 0>, 0 brdf lambert { } }\n" +
         more + "\n";
}

bool looksLikePicture(const std::string& file) {
  const std::string bytes = contents(file);
  const bool png =
      bytes.rfind("\x89PNG\r\n\x1a\n", 0) == 0 && bytes.find("IEND") != std::string::npos;
  const bool exr = bytes.rfind("\x76\x2f\x31\x01", 0) == 0 && bytes.size() > 500;
  return png || exr;
}
