// Which names are of one file, and which file may be replaced by which.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <fstream>

#include "base/files.hpp"
#include "unit/temporary_folder.hpp"

namespace strut {
namespace {

namespace fs = std::filesystem;

class Files : public testing::Test {
 protected:
  const Communicator world;
  const TemporaryFolder folder{world};

  fs::path write(const std::string& name, const std::string& content) const {
    std::ofstream(folder / name, std::ios::binary) << content;
    return folder / name;
  }
};

TEST_F(Files, OneFileHasManyNames) {
  const fs::path file = write("a.e", "x");
  write("b.e", "x");
  fs::create_directory(folder / "sub");
  fs::create_symlink("a.e", folder / "soft");
  fs::create_hard_link(file, folder / "hard");
  fs::create_directory_symlink(".", folder / "here");
  for (const char* name : {"a.e", "./a.e", "soft", "hard", "sub/../a.e", "here/a.e"}) {
    EXPECT_TRUE(same_file(file, folder / name)) << name;
  }
  for (const char* name : {"b.e", "c.e", "sub/a.e", "A.e"}) EXPECT_FALSE(same_file(file, folder / name)) << name;
}

// Before the first of both is written: by a name from here, by an absolute one, and through links that lead to nothing.
TEST_F(Files, OneFileThatIsNotThereYetHasManyNames) {
  const fs::path before = fs::current_path();
  fs::current_path(folder / ".");
  fs::create_directory("sub");
  fs::create_symlink("new.e", "soft");
  fs::create_symlink("../soft", "sub/soft");
  fs::create_symlink("loop", "loop");
  for (const fs::path& name : {fs::path("./new.e"), folder / "new.e", fs::path("sub/../new.e"), fs::path("soft"),
                               fs::path("sub/soft"), fs::path("NEW.e")}) {
    EXPECT_TRUE(same_file("new.e", name)) << name;
  }
  for (const char* name : {"other.e", "sub/new.e", "nowhere/new.e", "loop"}) {
    EXPECT_FALSE(same_file("new.e", name)) << name;
  }
  EXPECT_TRUE(same_file("new.e", "nowhere/../new.e"));
  EXPECT_FALSE(same_file("", "new.e")) << "a deck that names no mesh";
  EXPECT_FALSE(same_file("", ""));
  fs::create_symlink("loop2", "loop2");
  EXPECT_FALSE(same_file("loop", "loop2"));
  fs::current_path(before);
}

// The heads of files of all kinds, as the libraries write them: a title stands with its number of characters.
TEST_F(Files, AFileIsReplacedByOneOfItsKindOnly) {
  const auto titled = [](const std::string& title, char version) {
    const std::string count = std::string(version == 5 ? 7 : 3, '\0') + static_cast<char>(title.size() + 1);
    return std::string("CDF") + version + std::string("title\0\0\0\0\0\0\2", 12) + count + title + std::string(4, '\0');
  };
  const std::array<std::pair<FileKind, std::string>, 7> kinds{
      {{FileKind::result, titled("strut", 2)},
       {FileKind::result, titled("strut", 5)},
       {FileKind::mesh, titled("strut mesh", 2)},
       {FileKind::checkpoint, std::string("CDF\5") + "strut_restart"},
       {FileKind::history, "# strut 0.1\n"},
       {FileKind::log, "# log of strut 0.1\n"},
       {FileKind::lock, ""}}};
  for (const auto& [kind, content] : kinds) {
    const fs::path file = write("file", content);
    for (const auto& [other, unused] : kinds) {
      EXPECT_EQ(obstacle(file, other).empty(), other == kind || content.empty())
          << content << " and " << static_cast<int>(other);
    }
  }
  for (const auto& [kind, unused] : kinds) {
    EXPECT_EQ(obstacle(write("file", std::string(48, '\0')), kind), "") << "killed before it had a header";
    EXPECT_NE(obstacle(write("file", std::string(2'000'000, '\0')), kind), "") << "voxels, say";
  }
  EXPECT_EQ(obstacle(write("file", std::string("CDF\2") + "api_version"), FileKind::result), "") << "as it is begun";
  for (const std::string content : {"shape = box\n", "\x89HDF\r\n", "<ParameterList/>", "CDF", "Time,x\n0,1\n"}) {
    const fs::path file = write("file", content);
    for (const auto& [kind, unused] : kinds) EXPECT_NE(obstacle(file, kind), "") << content;
    EXPECT_EQ(obstacle(file, FileKind::unchecked), "");
  }
  EXPECT_NE(obstacle(write("file", "\x89HDF\r\n"), FileKind::result).find("netCDF-4"), std::string::npos);
  EXPECT_NE(obstacle(write("file", log_mark), FileKind::history).find("a log of strut (this run's --log?)"),
            std::string::npos);
  EXPECT_NE(obstacle(folder / ".", FileKind::log).find("is a folder"), std::string::npos);
  EXPECT_NE(obstacle(folder / "no/file", FileKind::log).find("there is no folder"), std::string::npos);
  const std::string longest(255, 'x');
  EXPECT_EQ(obstacle(folder / longest, FileKind::result), "");
  EXPECT_NE(obstacle(folder / (longest + "x"), FileKind::result).find("its name has 256 bytes; expected up to 255"),
            std::string::npos);
  EXPECT_EQ(obstacle("/dev/null", FileKind::log), "") << "loses nothing";
  EXPECT_NE(obstacle("/dev/null", FileKind::result), "");
}

// The lines of the terminal would stand between those of the history.
TEST_F(Files, WhereTheTerminalsOutputGoesNothingElseIsWritten) {
  const fs::path file = write("history.csv", "");
  fs::create_symlink("history.csv", folder / "link");
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO}) {
    EXPECT_EQ(obstacle(file, FileKind::history), "");
    const int terminal = ::dup(stream), there = ::open(file.c_str(), O_WRONLY);
    ::dup2(there, stream);
    const std::array said{obstacle(file, FileKind::history), obstacle(folder / "link", FileKind::unchecked),
                          obstacle("/dev/fd/" + std::to_string(stream), FileKind::log)};
    const std::string other = obstacle(folder / "other.csv", FileKind::history);
    ::dup2(terminal, stream);
    ::close(terminal), ::close(there);
    for (const std::string& one : said)
      EXPECT_NE(one.find("standard output or standard error"), std::string::npos) << one;
    EXPECT_EQ(other, "");
  }
}

// A pipe without a reader or a writer would be waited for without an end.
TEST_F(Files, APipeIsNeitherReadNorWritten) {
  const fs::path pipe = folder / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  for (const FileKind kind : {FileKind::log, FileKind::mesh, FileKind::result, FileKind::unchecked}) {
    EXPECT_NE(obstacle(pipe, kind).find("is a folder, a pipe or a device"), std::string::npos);
  }
  EXPECT_NE(unreadable(pipe).find("it is a pipe or a device"), std::string::npos);
  EXPECT_NE(unreadable("/dev/zero").find("it is a pipe or a device"), std::string::npos);
  EXPECT_NE(unreadable(folder / ".").find("it is a directory"), std::string::npos);
  EXPECT_NE(unreadable(folder / "none").find("no such file"), std::string::npos);
  EXPECT_EQ(unreadable(write("file", "text")), "");
}

// As Excel and PowerShell write texts, with a mark at the beginning or without one.
TEST_F(Files, ATextOfTwoBytesALetterIsNotRead) {
  for (const std::string text :
       {std::string("\377\3765"), std::string("\376\3775"), std::string("5\0", 2), std::string("\0005", 2)})
    EXPECT_NE(unreadable(write("file", text)).find("UTF-16"), std::string::npos);
}

}  // namespace
}  // namespace strut
