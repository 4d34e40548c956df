#include "integrators/quasi_static/krylov.hpp"

#include <Amesos2_KLU2.hpp>
#include <BelosPseudoBlockGmresSolMgr.hpp>
#include <BelosTpetraAdapter.hpp>
#include <MueLu_CreateTpetraPreconditioner.hpp>
#include <MueLu_Hierarchy.hpp>
#include <MueLu_SmootherBase.hpp>
#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_CrsMatrix.hpp>
#if __has_include(<Tpetra_Details_Random.hpp>)
#include <Tpetra_Details_Random.hpp>
#endif
#include <cstdlib>
#include <exception>
#include <iostream>
#include <sstream>

namespace strut {

namespace {

using Map = Tpetra::Map<>;
using Matrix = Tpetra::CrsMatrix<double>;
using Vectors = Tpetra::MultiVector<double>;
using Operator = Tpetra::Operator<double>;
using Teuchos::RCP;
using Teuchos::rcp;

void copy(const Field& field, Vectors& vectors, std::size_t column = 0) {
  const auto data = vectors.getDataNonConst(column);
  for (std::size_t i = 0; i < field.size(); ++i) {
    for (int c = 0; c < 3; ++c) data[3 * i + c] = field[i][c];
  }
}

void copy(const Vectors& vectors, Field& field) {
  const auto data = vectors.getData(0);
  for (std::size_t i = 0; i < field.size(); ++i) {
    for (int c = 0; c < 3; ++c) field[i][c] = data[3 * i + c];
  }
}

// A matrix-vector product as an operator of Belos.
class ProductOperator : public Operator {
 public:
  ProductOperator(Krylov::Product product, RCP<const Map> map, std::size_t owned)
      : product_(std::move(product)), map_(std::move(map)), in_(owned), out_(owned) {}
  RCP<const Map> getDomainMap() const override { return map_; }
  RCP<const Map> getRangeMap() const override { return map_; }
  void apply(const Vectors& X, Vectors& Y, Teuchos::ETransp, double alpha, double beta) const override {
    copy(X, in_);
    product_(in_, out_);
    if (beta == 0) {
      for (Eigen::Vector3d& v : out_) v *= alpha;
      return copy(out_, Y);
    }
    Vectors product(map_, 1);
    copy(out_, product);
    Y.update(alpha, product, beta);
  }

 private:
  Krylov::Product product_;
  RCP<const Map> map_;
  mutable Field in_, out_;
};

RCP<Matrix> assembled(const BlockRows& rows, const RCP<const Map>& map) {
  using Global = Map::global_ordinal_type;
  std::size_t widest = 0;
  for (std::size_t i = 0; i + 1 < rows.start.size(); ++i) {
    widest = std::max(widest, 3 * (rows.start[i + 1] - rows.start[i]));
  }
  const RCP<Matrix> matrix = rcp(new Matrix(map, widest));
  std::vector<Global> columns;
  std::vector<double> values;
  for (std::size_t i = 0; i + 1 < rows.start.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      columns.clear(), values.clear();
      for (std::size_t e = rows.start[i]; e < rows.start[i + 1]; ++e) {
        for (int d = 0; d < 3; ++d) {
          columns.push_back(3 * static_cast<Global>(rows.columns[e]) + d);
          values.push_back(rows.blocks[e](c, d));
        }
      }
      const Global row = map->getGlobalElement(static_cast<int>(3 * i + c));
      matrix->insertGlobalValues(row, Teuchos::ArrayView<const Global>(columns),
                                 Teuchos::ArrayView<const double>(values));
    }
  }
  matrix->fillComplete();
  return matrix;
}

}  // namespace

struct Krylov::Implementation {
  RCP<const Map> map;
  std::size_t owned;
  RCP<Operator> hierarchy;  // null before the first
};

Krylov::Krylov(const RCP<const Teuchos::Comm<int>>& ranks, int owned) {
  const auto everywhere = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  const RCP<const Map> map = rcp(new Map(everywhere, 3 * static_cast<std::size_t>(owned), 0, ranks));
  implementation_ = std::make_unique<Implementation>(Implementation{map, static_cast<std::size_t>(owned), {}});
}

Krylov::~Krylov() = default;

std::int64_t Krylov::first() const {
  return implementation_->owned == 0 ? 0 : implementation_->map->getMinGlobalIndex() / 3;
}

void Krylov::precondition_by(Product inverse) {
  implementation_->hierarchy =
      rcp(new ProductOperator(std::move(inverse), implementation_->map, implementation_->owned));
}

bool Krylov::is_preconditioned() const { return !implementation_->hierarchy.is_null(); }

namespace {

// Captures the error stream: MueLu prints an exception before it throws it on.
class QuietErrors {
 public:
  QuietErrors() : before_(std::cerr.rdbuf(kept_.rdbuf())) {}
  QuietErrors(const QuietErrors&) = delete;
  ~QuietErrors() { std::cerr.rdbuf(before_); }

 private:
  std::ostringstream kept_;
  std::streambuf* before_;
};

// Trilinos estimates eigenvalues from random vectors. MueLu seeds std::rand for each hierarchy, and Trilinos 13.2 takes
// them from there; later versions use one generator throughout, so that results would depend on where a run was
// resumed.
void seed_random_vectors([[maybe_unused]] int rank) {
#if __has_include(<Tpetra_Details_Random.hpp>)
  std::srand(1);
  Tpetra::Details::Static_Random_XorShift64_Pool<Map::execution_space>::resetPool(rank);
#endif
}

using Smoother = MueLu::SmootherBase<double, int, Map::global_ordinal_type, Map::node_type>;
using CoarseVectors = Xpetra::MultiVector<double, int, Map::global_ordinal_type, Map::node_type>;
using Factors = Amesos2::KLU2<Matrix, Vectors>;

// Factors of the coarsest grid on several ranks. KLU2 leaves a quarter of the right side there (Trilinos 13.2), by
// which a body drifts along each direction in which nothing holds it; its solver of the transposed system, the same one
// here, is exact.
class Coarsest : public Smoother {
 public:
  explicit Coarsest(RCP<Factors> factors) : factors_(std::move(factors)) {
    const RCP<Teuchos::ParameterList> options = rcp(new Teuchos::ParameterList("Amesos2"));
    options->sublist(factors_->name).set("Trans", "TRANS");
    factors_->setParameters(options);
  }
  void Apply(CoarseVectors& x, const CoarseVectors& right, bool) const override {
    factors_->setX(Teuchos::rcpFromRef(Xpetra::toTpetra(x)));
    factors_->setB(Teuchos::rcpFromRef(Xpetra::toTpetra(right)));
    factors_->solve();
  }
  std::size_t getNodeSmootherComplexity() const override { return Teuchos::OrdinalTraits<std::size_t>::invalid(); }

 private:
  RCP<Factors> factors_;
};

void factorize_coarsest(const RCP<Operator>& preconditioner) {
  using Preconditioner = MueLu::TpetraOperator<double, int, Map::global_ordinal_type, Map::node_type>;
  using CoarseMatrix = Xpetra::Matrix<double, int, Map::global_ordinal_type, Map::node_type>;
  using Helpers = Xpetra::Helpers<double, int, Map::global_ordinal_type, Map::node_type>;
  const auto hierarchy = Teuchos::rcp_dynamic_cast<Preconditioner>(preconditioner, true)->GetHierarchy();
  const auto level = hierarchy->GetLevel(hierarchy->GetNumLevels() - 1);
  const RCP<const Matrix> matrix = Helpers::Op2TpetraCrs(level->Get<RCP<CoarseMatrix>>("A"));
  const RCP<Smoother> coarsest = rcp(new Coarsest(rcp(new Factors(matrix, Teuchos::null, Teuchos::null))));
  level->Set("PreSmoother", coarsest);
}

// Null if Trilinos finds no hierarchy on some rank; `trouble` is then its message. The coarsest grid is factorized at
// its first use, which is here.
RCP<Operator> hierarchy_of(const RCP<Operator>& matrix, Teuchos::ParameterList options, std::string& trouble) {
  RCP<Operator> hierarchy;
  try {
    const QuietErrors quiet;
    seed_random_vectors(matrix->getDomainMap()->getComm()->getRank());
    hierarchy = MueLu::CreateTpetraPreconditioner(matrix, options);
    const bool has_factors = !options.isParameter("coarse: type");
    if (has_factors && matrix->getDomainMap()->getComm()->getSize() > 1) factorize_coarsest(hierarchy);
    Vectors ones(matrix->getDomainMap(), 1), result(matrix->getRangeMap(), 1);
    ones.putScalar(1);
    hierarchy->apply(ones, result);
  } catch (const std::exception& error) {  // on all ranks, because they share the coarsest grid
    trouble = error.what();
    hierarchy = {};
  }
  const int own = hierarchy.is_null() ? 1 : 0;
  int any = 0;
  Teuchos::reduceAll(*matrix->getDomainMap()->getComm(), Teuchos::REDUCE_MAX, own, Teuchos::outArg(any));
  return any > 0 ? RCP<Operator>() : hierarchy;
}

// False if all points are held: a coarser grid would have no unknowns.
bool couples_points(const BlockRows& rows, const Teuchos::Comm<int>& ranks) {
  int here = 0, anywhere = 0;
  for (std::size_t i = 0; i + 1 < rows.start.size(); ++i) {
    for (std::size_t e = rows.start[i] + 1; e < rows.start[i + 1]; ++e) here |= rows.blocks[e].isZero(0) ? 0 : 1;
  }
  Teuchos::reduceAll(ranks, Teuchos::REDUCE_MAX, here, Teuchos::outArg(anywhere));
  return anywhere > 0;
}

}  // namespace

std::string Krylov::precondition(const BlockRows& rows, const std::vector<Field>& kernel) {
  const RCP<const Map>& map = implementation_->map;
  implementation_->hierarchy = {};
  if (!couples_points(rows, *map->getComm())) return "";
  const RCP<Vectors> modes = rcp(new Vectors(map, kernel.size()));
  for (std::size_t m = 0; m < kernel.size(); ++m) copy(kernel[m], *modes, m);
  Teuchos::ParameterList options;
  options.set("verbosity", "none");
  options.set("number of equations", 3);
  options.set("multigrid algorithm", "sa");
  options.set("coarse: max size", 300);
  // The matrix only resembles the system: more smoothing would take longer than the iterations that it saves.
  options.set("smoother: type", "CHEBYSHEV");
  options.sublist("smoother: params").set("chebyshev: degree", 1);
  options.set("smoother: pre or post", "pre");
  options.sublist("user data").set("Nullspace", modes);
  const RCP<Operator> matrix = assembled(rows, map);
  std::string trouble;
  implementation_->hierarchy = hierarchy_of(matrix, options, trouble);
  if (is_preconditioned()) return "";
  options.set("coarse: type", "CHEBYSHEV");
  options.sublist("coarse: params").set("chebyshev: degree", 4);
  implementation_->hierarchy = hierarchy_of(matrix, options, trouble);
  const char* const instead = is_preconditioned() ? "its coarsest grid is smoothed instead" : "it goes on without";
  std::string text = std::string("the preconditioner could not be made as usual; ") + instead;
  if (!trouble.empty())
    text += " (Trilinos: " + trouble.substr(trouble.find_last_of('\n', trouble.size() - 2) + 1) + ")";
  return text;
}

Krylov::Outcome Krylov::solve(const Product& K, const Field& right, Measure measure, double tolerance, int most,
                              Field& x) {
  constexpr int restart_length = 200;  // directions before a restart
  const RCP<const Map>& map = implementation_->map;
  const RCP<Operator> product = rcp(new ProductOperator(K, map, implementation_->owned));
  const RCP<Vectors> solution = rcp(new Vectors(map, 1)), wanted = rcp(new Vectors(map, 1));
  copy(right, *wanted);
  const auto problem = rcp(new Belos::LinearProblem<double, Vectors, Operator>(product, solution, wanted));
  const bool by_error = measure == Measure::error && is_preconditioned();
  if (by_error) problem->setLeftPrec(implementation_->hierarchy);
  if (!by_error && is_preconditioned()) problem->setRightPrec(implementation_->hierarchy);
  problem->setProblem();
  const RCP<Teuchos::ParameterList> options = rcp(new Teuchos::ParameterList);
  options->set("Convergence Tolerance", tolerance);
  options->set("Num Blocks", std::min(restart_length, most));
  options->set("Maximum Restarts", most / restart_length);
  options->set("Maximum Iterations", most);
  const char* const scaling = by_error ? "Norm of Preconditioned Initial Residual" : "Norm of RHS";
  options->set("Implicit Residual Scaling", scaling);
  options->set("Explicit Residual Scaling", scaling);
  Belos::PseudoBlockGmresSolMgr<double, Vectors, Operator> solver(problem, options);
  x.assign(implementation_->owned, Eigen::Vector3d::Zero());
  try {
    const bool converged = solver.solve() == Belos::Converged;
    copy(*solution, x);
    return {solver.getNumIters(), converged};
  } catch (const Belos::BelosError&) {  // a number is not finite, the same on all ranks: there is no step
    return {most, false};
  }
}

}  // namespace strut
