#include "io/netcdf/trial_read.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>

#include "base/errors.hpp"

namespace strut::io {

namespace {

bool trial_reads = true;

// Limit of processor time, s: ten times that of the slowest compressed file.
rlim_t patience(const std::filesystem::path& file) {
  std::error_code ignored;
  return 10 + std::filesystem::file_size(file, ignored) / 10'000'000;
}

// In the child process: no output of the library, no core dump, a time limit, and no signal handlers of ours or of MPI.
void prepare(const std::filesystem::path& file) {
  const int nowhere = ::open("/dev/null", O_WRONLY);
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
  const rlimit none = {0, 0}, seconds = {patience(file), patience(file)};
  setrlimit(RLIMIT_CORE, &none);
  setrlimit(RLIMIT_CPU, &seconds);
  for (const int fatal : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGXCPU}) signal(fatal, SIG_DFL);
}

// Reads the file; sends an exception to the parent process as text.
[[noreturn]] void perform(const std::filesystem::path& file, const std::function<void()>& read, int pipe) {
  prepare(file);
  std::string problem;
  try {
    read();
  } catch (const std::exception& error) {
    problem = error.what();
  }
  for (std::size_t done = 0; done < problem.size();) {
    const ssize_t count = ::write(pipe, problem.data() + done, problem.size() - done);
    if (count <= 0) break;
    done += static_cast<std::size_t>(count);
  }
  _exit(0);
}

std::string all_from(int pipe) {
  std::string text;
  char part[4096];
  for (;;) {
    const ssize_t count = ::read(pipe, part, sizeof part);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return text;
    text.append(part, static_cast<std::size_t>(count));
  }
}

int status_of(pid_t process) {
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

}  // namespace

void set_trial_reads(bool wanted) { trial_reads = wanted; }

bool is_hdf5(const std::filesystem::path& file) {
  std::string magic(4, '\0');  // the rest may be damaged
  if (std::filesystem::is_regular_file(file)) std::ifstream(file, std::ios::binary).read(magic.data(), 4);
  return magic == "\x89HDF";
}

void try_in_child_process(const std::filesystem::path& file, const std::function<void()>& read) {
  if (!trial_reads || !is_hdf5(file)) return;
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw Error(file.string() + ": cannot open it: too many open files");
  const pid_t copy = fork();
  if (copy == 0) perform(file, read, ends[1]);
  ::close(ends[1]);
  const std::string problem = all_from(ends[0]);
  ::close(ends[0]);
  if (copy < 0) throw Error(file.string() + ": cannot open it: no process can be started to look at it first");
  const int status = status_of(copy);
  if (!problem.empty()) throw Error(problem);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  const bool late = WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL);
  throw Error(file.string() + ": cannot read it: the HDF5 library " + (late ? "does not come to an end" : "crashes") +
              " (a damaged file)");
}

}  // namespace strut::io
