#include "io/netcdf/wide_netcdf.hpp"

#include <netcdf.h>
#include <netcdf_mem.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "base/errors.hpp"

namespace strut::io {

namespace {

namespace fs = std::filesystem;

class Handle {
 public:
  explicit Handle(const fs::path& path) : path_(path) {}
  ~Handle() {
    if (open_) nc_abort(number);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;

  void check(int code) const {
    if (code == NC_NOERR) return;
    const char* why = code > 0 ? std::strerror(code) : nc_strerror(code);
    throw Error(path_.string() + ": cannot give it 64-bit sizes: " + why);
  }
  void opened(int code) { check(code), open_ = true; }
  NC_memio close_in_memory() {
    NC_memio content{};
    open_ = false, check(nc_close_memio(number, &content));
    return content;
  }

  int number = -1;

 private:
  fs::path path_;
  bool open_ = false;
};

void copy_attributes(const Handle& from, int of, int count, const Handle& to) {
  for (int a = 0; a < count; ++a) {
    char name[NC_MAX_NAME + 1];
    from.check(nc_inq_attname(from.number, of, a, name));
    to.check(nc_copy_att(from.number, of, name, to.number, of));
  }
}

// Copies the header; the numbers of dimensions and variables stay the same.
void copy_header(const Handle& from, const Handle& to) {
  int dimensions = 0, variables = 0, attributes = 0, unlimited = -1;
  from.check(nc_inq(from.number, &dimensions, &variables, &attributes, &unlimited));
  char name[NC_MAX_NAME + 1];
  for (int d = 0, number = 0; d < dimensions; ++d) {
    std::size_t length = 0;
    from.check(nc_inq_dim(from.number, d, name, &length));
    to.check(nc_def_dim(to.number, name, d == unlimited ? NC_UNLIMITED : length, &number));
  }
  copy_attributes(from, NC_GLOBAL, attributes, to);
  for (int v = 0, number = 0; v < variables; ++v) {
    nc_type type = 0;
    int rank = 0, of_variable = 0;
    std::vector<int> shape(NC_MAX_VAR_DIMS);
    from.check(nc_inq_var(from.number, v, name, &type, &rank, shape.data(), &of_variable));
    to.check(nc_def_var(to.number, name, type, rank, shape.data(), &number));
    copy_attributes(from, v, of_variable, to);
  }
}

}  // namespace

// The file keeps its identity, because the run has locked it. The wide header is made in memory, so that a run killed
// here leaves no second file behind.
void widen(const fs::path& path) {
  Handle from(path), to(path);
  from.opened(nc_open(path.c_str(), NC_NOWRITE, &from.number));
  to.opened(nc_create_mem(path.c_str(), NC_64BIT_DATA, 0, &to.number));
  copy_header(from, to);
  to.check(nc_enddef(to.number));
  const NC_memio wide = to.close_in_memory();
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file.write(static_cast<const char*>(wide.memory), static_cast<std::streamsize>(wide.size));
  file.close();
  std::free(wide.memory);
  if (!file) throw Error(path.string() + ": cannot give it 64-bit sizes: " + std::strerror(errno));
}

}  // namespace strut::io
