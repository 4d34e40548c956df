// The C++ part of the Python module strut; strut/*.py build the interface for users on it.
#include <mpi.h>
#include <pybind11/iostream.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <sstream>

#include "base/build_facts.hpp"
#include "base/errors.hpp"
#include "base/numbers.hpp"
#include "base/parallel/communicator.hpp"
#include "base/parallel/gather_scatter.hpp"
#include "base/parallel/launch.hpp"
#include "base/parallel/threads.hpp"
#include "deck/deck.hpp"
#include "deck/yaml.hpp"
#include "mesh/arrays.hpp"
#include "mesh/body.hpp"
#include "output/observables.hpp"
#include "output/variables.hpp"
#include "python/numpy.hpp"
#include "run/input.hpp"
#include "run/run_control.hpp"
#include "run/simulation.hpp"
#include "run/start_from.hpp"
#include "setup/setup.hpp"

namespace strut {

namespace {

std::unique_ptr<Runtime> runtime;

// The ranks of the job.
Communicator world() {
  static int no_words = 0;
  static char** no_word = nullptr;
  if (!runtime) runtime = std::make_unique<Runtime>(no_words, no_word);
  Communicator ranks;
  const std::string problem = wrong_launcher(launch_of_process(), ranks.size(), "python3");
  if (!problem.empty()) throw Error(problem);
  return ranks;
}

// After an error that nothing has caught: ends the job, whose other ranks may wait for this one, unless all come here,
// with the same error, in seconds.
void end_job() {
  int has_begun = 0, has_ended = 0, all_are_here = 0;
  MPI_Initialized(&has_begun);
  MPI_Finalized(&has_ended);
  if (has_begun == 0 || has_ended != 0) return;
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Ibarrier(MPI_COMM_WORLD, &request);
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(3);
  while (all_are_here == 0 && std::chrono::steady_clock::now() < end)
    MPI_Test(&request, &all_are_here, MPI_STATUS_IGNORE);
  if (all_are_here == 0) MPI_Abort(MPI_COMM_WORLD, 1);
}

// A deck, as lists of parameters, to nested dictionaries.
py::object value_of(const deck::Parameter& parameter) {
  const auto& [name, type, value] = parameter;
  if (type == "bool") {
    if (const auto truth = to_boolean(value)) return py::bool_(*truth);
  }
  if (type == "int") {
    if (const auto number = to_integer(value)) return py::int_(*number);
  }
  if (type == "double") {
    if (const auto number = to_real(value)) return py::float_(*number);
  }
  if (type == "Array(double)") {
    if (const auto numbers = to_reals(value)) return py::cast(*numbers);
  }
  return py::str(value);
}

py::dict dictionary_of(const deck::List& list) {
  py::dict all;
  for (const deck::Parameter& parameter : list.parameters) all[parameter.name.c_str()] = value_of(parameter);
  for (const deck::List& section : list.lists) all[section.name.c_str()] = dictionary_of(section);
  return all;
}

py::dict parsed(const std::string& text, const std::string& name) {
  deck::Problems problems;
  const std::optional<deck::List> list = deck::parse_xml_or_yaml(text, problems);
  problems.raise(name);
  return dictionary_of(list.value());
}

// Gathered voxels, as strut-mesh --arrays reads them.
io::Mesh mesh_of_voxels(const std::string& stream) {
  std::istringstream in(stream);
  std::string summary;
  io::Mesh mesh = mesh::read_arrays(in, "the mesh", &summary);
  py::print(summary, py::arg("end") = "");
  return mesh;
}

io::Mesh mesh_of_recipe(const std::string& recipe) {
  std::string summary;
  io::Mesh mesh = mesh::mesh_of(mesh::read_recipe(recipe), summary);
  py::print(summary, py::arg("end") = "");
  return mesh;
}

// While a run works, signals end it as they end the program: after the next step, with a frame and a checkpoint. They
// then have their usual effect in Python: Ctrl-C is a KeyboardInterrupt, on all ranks.
class Signals {
 public:
  Signals() {
    forget_signals();
    for (std::size_t k = 0; k < caught.size(); ++k) sigaction(caught[k], nullptr, &before_[k]);
    catch_signals({SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGUSR2, SIGXCPU});
  }
  ~Signals() {
    for (std::size_t k = 0; k < caught.size(); ++k) sigaction(caught[k], &before_[k], nullptr);
  }
  Signals(const Signals&) = delete;
  Signals& operator=(const Signals&) = delete;

 private:
  static constexpr std::array caught{SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGUSR2, SIGXCPU};
  std::array<struct sigaction, caught.size()> before_ = {};
};

// Runs share MPI, the output and the handlers of signals of this process: only one works at a time, and meanwhile no
// call may read another one.
class Working {
 public:
  Working() { check(), at_work_ = true; }
  ~Working() { at_work_ = false; }
  Working(const Working&) = delete;
  Working& operator=(const Working&) = delete;

  static void check() {
    if (at_work_) throw Error("a run works in another thread of this process; expected one that waits for it");
  }

 private:
  static inline bool at_work_ = false;  // read and set with the lock of the interpreter
};

class PythonRun {
 public:
  // `output`: an object with write(text) and flush(), which gets the output of the run. Only rank 0's mesh is used.
  PythonRun(const std::string& text, const std::string& name, const io::Mesh* mesh, bool continues, py::object output)
      : ranks_(world()), output_(std::move(output)) {
    working([&] {
      deck::Problems problems;
      deck::Deck deck = deck::read_text(text, name, ranks_, problems);
      run_.emplace(std::move(deck), std::move(problems), ranks_, continues ? Start::continued : Start::anew,
                   InMemory{mesh, &rows_});
      run_->advance({.steps = 0});
    });
  }

  bool advance(std::optional<int> steps, std::optional<double> time) {
    bool goes_on = false;
    const Pause never;
    working([&] { goes_on = mine().advance({steps.value_or(never.steps), time.value_or(never.time)}); });
    return goes_on;
  }

  void end() {
    working([&] { mine().end(); });
  }

  Run& run() {
    Working::check();
    return mine();
  }
  const Body& body() { return run().scene().body; }
  const Communicator& ranks() const { return ranks_; }
  const HistoryRows& rows() {
    Working::check();
    return rows_;
  }
  void close() { run_.reset(); }

 private:
  Run& mine() {
    if (!run_) throw Error("the run is closed: Python ends");
    return *run_;
  }

  // Runs `action` without the lock of the interpreter; what it prints goes to Python.
  template <class Action>
  void working(const Action& action) {
    const Working alone;
    const py::scoped_ostream_redirect redirected(std::cout, output_);
    int number = 0;
    {
      const Signals signals;
      const py::gil_scoped_release released;
      action();
      number = static_cast<int>(ranks_.max(caught_signal()));
      if (number != 0 && run_ && !run_->has_ended()) run_->end();
    }
    if (number == 0) return;
    std::raise(number);
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }

  Communicator ranks_;
  py::object output_;
  HistoryRows rows_;
  std::optional<Run> run_;
};

// A field of all points in the order of the mesh, gathered on rank 0; NaN for points that were dropped.
py::object whole(PythonRun& run, const std::string& name) {
  const Observable one = chosen(observables(run.body()), name, "fields");
  const PointCloud& cloud = run.body().domain.cloud;
  std::vector<double> mine;
  one.fill(run.body(), mine);
  const std::vector<double> values = gather<double>(run.ranks(), mine);
  const std::vector<std::int64_t> ids = gather<std::int64_t>(run.ranks(), cloud.ids);
  if (run.ranks().rank() != 0) return py::none();
  const auto width = static_cast<std::size_t>(one.components);
  const Scene& scene = run.run().scene();
  // Points at nodes have the numbers of the nodes, with gaps where a node has no element.
  const std::int64_t points =
      std::max(scene.points + scene.dropped.points, *std::max_element(ids.begin(), ids.end()) + 1);
  std::vector<double> all(static_cast<std::size_t>(points) * width, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(i * width), width,
                all.begin() + static_cast<std::ptrdiff_t>(ids[i]) * one.components);
  }
  return array_of(std::move(all), one.components);
}

py::object field(const py::object& owner, const std::string& name) {
  auto& run = owner.cast<PythonRun&>();
  if (py::object view = view_of(run.body(), name, owner); !view.is_none()) return view;
  const Observable one = chosen(observables(run.body()), name, "fields");
  std::vector<double> values;
  one.fill(run.body(), values);
  return read_only(array_of(std::move(values), one.components));
}

py::list blocks_of(PythonRun& run) {
  py::list names;
  for (const int block : run.body().domain.cloud.blocks) names.append(run.body().domain.cloud.block_names[block]);
  return names;
}

py::tuple history(PythonRun& run) {
  py::list names, units;
  for (const io::HistoryColumn& column : run.rows().columns) names.append(column.name), units.append(column.unit);
  return py::make_tuple(names, units, array_of(run.rows().values, std::max<int>(1, py::len(names))));
}

// All problems of a deck with its mesh, as the start of a run would find them; "" if there are none.
std::string problems_of(const std::string& text, const std::string& name, const io::Mesh* mesh) {
  const Communicator ranks = world();
  const Working alone;
  try {
    deck::Problems problems;
    const deck::Deck deck = deck::read_text(text, name, ranks, problems);
    if (mesh == nullptr && deck.discretization.type == deck::MeshType::memory) {
      problems.raise(name);
      return "";
    }
    start_state_of(deck, ranks, problems);
    const Scene scene = set_up(deck, checked_mesh(deck, std::move(problems), ranks, mesh), ranks);
    output_variables_of(deck, scene.body, scene.contact);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace

}  // namespace strut

PYBIND11_MODULE(_core, module) {
  using namespace strut;
  py::register_exception<Error>(module, "Error", PyExc_RuntimeError);
  module.def("version", &build_facts, "The version of strut, and how it was built.");
  module.def("parsed", &parsed);
  module.def("problems", &problems_of);
  module.def("rank", [] { return world().rank(); });
  module.def("any", [](bool mine) { return world().max(mine ? 1.0 : 0.0) > 0; });
  module.def("end_job", &end_job);
  module.def("finish", [] { runtime.reset(); });
  const auto set_threads_of_ranks = [](int count) {
    world();  // MPI says how many it allows
    if (const std::string problem = set_threads(count); !problem.empty()) throw Error(problem);
  };
  module.def("set_threads", set_threads_of_ranks, py::arg("count"),
             "The number of threads of each rank, as strut --threads.");

  py::class_<io::Mesh>(module, "Mesh")
      .def(py::init<>())
      .def("set_nodes", &set_nodes)
      .def("add_block", &add_block)
      .def("add_set", &add_set)
      .def_static("of_voxels", [](const py::bytes& stream) { return mesh_of_voxels(stream); })
      .def_static("of_recipe", &mesh_of_recipe)
      .def_static("of_file", [](const std::string& file) { return io::read_mesh(file); })
      .def("write", [](const io::Mesh& mesh, const std::string& file) { io::replace_mesh(file, mesh); })
      .def_property_readonly("nodes", &nodes_of)
      .def_property_readonly("blocks", &elements_of)
      .def_property_readonly("sets", &sets_of);

  py::class_<PythonRun>(module, "Run")
      .def(py::init<const std::string&, const std::string&, const io::Mesh*, bool, py::object>())
      .def("advance", &PythonRun::advance)
      .def("end", &PythonRun::end)
      .def("close", &PythonRun::close)
      .def_property_readonly("time", [](PythonRun& run) { return run.run().time(); })
      .def_property_readonly("steps", [](PythonRun& run) { return run.run().steps(); })
      .def_property_readonly("has_ended", [](PythonRun& run) { return run.run().has_ended(); })
      .def_property_readonly("is_over", [](PythonRun& run) { return run.run().is_over(); })
      .def_property_readonly("rank", [](const PythonRun& run) { return run.ranks().rank(); })
      .def_property_readonly("names", [](PythonRun& run) { return names_of(observables(run.body())); })
      .def_property_readonly("ids", [](PythonRun& run) { return py::array(py::cast(run.body().domain.cloud.ids)); })
      .def_property_readonly("blocks", &blocks_of)
      .def_property_readonly("positions",
                             [](const py::object& owner) { return places(owner.cast<PythonRun&>().body(), owner); })
      .def("field", [](const py::object& owner, const std::string& name) { return field(owner, name); })
      .def("whole", &whole)
      .def("history", &history);
}
