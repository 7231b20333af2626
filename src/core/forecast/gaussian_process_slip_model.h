#pragma once
/// Slip as a Gaussian process of time, for every model of latent_model.h.

#include <memory>
#include <optional>
#include <string>

#include "core/forecast/gp/gaussian_process.h"
#include "core/forecast/gp/hyperparameter_fit.h"
#include "core/forecast/gp/latent_model.h"
#include "core/forecast/gp/state_space_gaussian_process.h"
#include "core/forecast/hyperparameter_prior.h"
#include "core/forecast/slip_model.h"
#include "slipnav/core/parameters/parameter_visitor.h"

namespace slipnav {

/// Part of the block `forecast`: which model, and how it is fitted.
struct SlipModelParameters {
  std::string model = "paper";      ///< a name of latentModelNames()
  std::string inference = "dense";  ///< dense: exact, cubic in samples; state_space: linear, RBF approximated
  int min_samples = 15;             ///< usable samples that a window must have
  double slip_floor = 1e-3;         ///< slip that varies by less is constant
  int max_evaluations = 60;         ///< of the likelihood, per local fit
  double tolerance = 1e-2;          ///< of the log posterior at which a fit ends
  PriorParameters prior;

  void visit(ParameterVisitor& v);
};

/// Fits a window from scratch on each call, starting from the last hyperparameters.
class GaussianProcessSlipModel : public SlipModel {
 public:
  /// Throws std::invalid_argument for an unknown model or kind of inference.
  explicit GaussianProcessSlipModel(const SlipModelParameters& parameters);

  /// With a custom regression for the components of `parameters.model`.
  GaussianProcessSlipModel(const SlipModelParameters& parameters, std::unique_ptr<GaussianProcess> process);

  /// A cold fit starts from several length scales and keeps the best result. A later one starts from the previous
  /// hyperparameters, unless the posterior of the new window is higher at one of the cold starts. For the dense
  /// regression this search uses its state-space form, which costs a tenth; the dense one is then fitted from its
  /// result, with the curvature found there.
  SlipFit fit(const SlipSamples& samples) override;
  bool isReady() const override { return current_.has_value(); }
  SlipPrediction predict(const Eigen::VectorXd& times_s) const override;
  Eigen::MatrixXd predictCovariance(const Eigen::VectorXd& times_s) const override;

  /// Discards hyperparameters and window: the next fit is a cold one.
  void reset();

 private:
  struct Conditioned {
    SlipWindow window;
    Eigen::VectorXd log_parameters;
    double log_marginal_likelihood = 0.0;
  };
  struct Choice {
    SlipFitStatus status = SlipFitStatus::kDefaults;
    Eigen::VectorXd log_parameters;
    int evaluations = 0;
  };

  Choice chooseHyperparameters(const SlipWindow& window, const std::vector<LogPrior>& priors);
  Choice search(const SlipWindow& window, const std::vector<LogPrior>& priors);
  std::vector<Eigen::VectorXd> startPoints(GaussianProcess& process, const std::vector<LogPrior>& priors,
                                           int& evaluations) const;
  Choice fitFrom(GaussianProcess& process, const std::vector<LogPrior>& priors,
                 const std::vector<Eigen::VectorXd>& starts) const;
  Eigen::VectorXd afterScout(const std::vector<LogPrior>& priors, const Eigen::VectorXd& scouted);
  Choice fitFromNearby(GaussianProcess& process, const std::vector<LogPrior>& priors, const Eigen::VectorXd& start);
  std::optional<Eigen::MatrixXd> curvatureAt(const std::vector<LogPrior>& priors, const Eigen::VectorXd& start);
  bool adopt(const SlipWindow& window, const Eigen::VectorXd& log_parameters);
  SlipFit report(const SlipWindow& window, SlipFitStatus status, int evaluations) const;
  Eigen::VectorXd sinceOrigin(const Eigen::VectorXd& times_s) const;

  SlipModelParameters parameters_;
  LatentModel latent_;
  std::unique_ptr<GaussianProcess> process_;
  std::unique_ptr<StateSpaceGaussianProcess> scout_;  ///< cheaper form of a dense process, for the search
  StateSpaceGaussianProcess* markov_ = nullptr;       ///< the scout, or the process itself if it is of that form
  std::optional<Conditioned> current_;
  std::optional<Eigen::VectorXd> last_good_;  ///< hyperparameters of the last fit that ended well
};

/// The dense or the state-space regression of a named model. Throws std::invalid_argument.
std::unique_ptr<GaussianProcess> makeGaussianProcess(const std::string& model, const std::string& inference);

}  // namespace slipnav
