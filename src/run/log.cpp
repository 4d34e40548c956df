#include "run/log.hpp"

#include <cerrno>
#include <cstring>
#include <string>

#include "base/build_facts.hpp"
#include "base/errors.hpp"
#include "base/files.hpp"

namespace strut {

// Passes output to the terminal at once. The file gets whole lines, so that those of ranks do not mix, each in its
// final form: a progress bar rewrites its line again and again.
class Log::Both : public std::streambuf {
 public:
  Both(std::streambuf* terminal, std::ofstream& file) : terminal_(terminal), file_(file) {}
  ~Both() override {
    if (!line_.empty()) end_line();
  }

 protected:
  int overflow(int character) override {
    if (character == traits_type::eof()) return traits_type::not_eof(character);
    const auto c = static_cast<char>(character);
    if (c == '\r') line_.clear();
    if (c == '\n') end_line();
    if (c != '\r' && c != '\n') line_ += c;
    return terminal_->sputc(c);
  }
  int sync() override { return terminal_->pubsync(); }

 private:
  void end_line() {
    line_ += '\n';
    file_ << line_ << std::flush;
    line_.clear();
  }

  std::streambuf* terminal_;
  std::ofstream& file_;
  std::string line_;
};

Log::Log(const std::filesystem::path& file, const Communicator& communicator)
    : terminal_out_(std::cout.rdbuf()), terminal_errors_(std::cerr.rdbuf()) {
  run_on_root(communicator, [&] {
    if (const std::string why = obstacle(file, FileKind::log); !why.empty()) throw Error("--log: " + why);
    try {
      const bool is_device = std::filesystem::exists(file) && !std::filesystem::is_regular_file(file);
      if (!is_device) lock_.emplace(file);
    } catch (const Error& error) {
      throw Error(std::string("--log: ") + error.what());
    }
    errno = 0;
    // The first line shows the next run that the file may be replaced.
    if (!(std::ofstream(file) << log_mark << strut_version() << std::endl))
      throw Error("--log: '" + file.string() + "': cannot create it: " + std::strerror(errno));
  });
  file_.open(file, std::ios::app);
  out_ = std::make_unique<Both>(terminal_out_, file_);
  errors_ = std::make_unique<Both>(terminal_errors_, file_);
  std::cout.rdbuf(out_.get());
  std::cerr.rdbuf(errors_.get());
}

Log::~Log() {
  std::cout.flush();
  std::cout.rdbuf(terminal_out_);
  std::cerr.rdbuf(terminal_errors_);
}

}  // namespace strut
