#pragma once
/// Interface of a model of wheel slip over time: fit a window, predict ahead.

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "core/forecast/slip_window.h"

namespace slipnav {

/// Result for a window.
enum class SlipFitStatus {
  kConverged,            ///< hyperparameters fitted
  kNotConverged,         ///< out of evaluations; the best hyperparameters found are used
  kKeptPrevious,         ///< the optimizer failed; this window with the hyperparameters of the last good fit
  kDefaults,             ///< the optimizer failed and there was no good fit yet; this window with the prior's means
  kConstantSlip,         ///< slip does not vary: nothing to fit; this window with the prior's means
  kTooFewSamples,        ///< window rejected
  kOriginAfterSample,    ///< window rejected: the given origin is later than its first sample
  kNotPositiveDefinite,  ///< window rejected: no regression with any available hyperparameters
};

/// One or two lower-case words, for messages and files.
const char* toString(SlipFitStatus status);

/// Whether the window was accepted. After a rejected one the model is unchanged.
bool isAccepted(SlipFitStatus status);

/// Report on one window.
struct SlipFit {
  SlipFitStatus status = SlipFitStatus::kTooFewSamples;
  int samples = 0;   ///< used
  int left_out = 0;  ///< see SlipWindow
  // Of the window if it was accepted, else of the previous one; empty and zero if there is none.
  double origin_s = 0.0;
  std::vector<std::pair<std::string, double>> hyperparameters;  ///< name (unit as suffix) and value
  double log_marginal_likelihood = 0.0;                         ///< of the samples used
  int evaluations = 0;                                          ///< of the likelihood, for this window

  /// By its name, with the unit; zero if the model has none of that name.
  double hyperparameter(const std::string& name) const;
};

/// The latent slip, without the noise of a single observation. Every number is finite.
struct SlipPrediction {
  Eigen::VectorXd times_s;  ///< on the clock of the samples
  Eigen::VectorXd mean;
  Eigen::VectorXd stddev;
};

/// Holds the last accepted window; predictions are made from it.
class SlipModel {
 public:
  virtual ~SlipModel() = default;

  /// Never throws for anything sensors may deliver; throws std::invalid_argument if times and slips differ in length.
  virtual SlipFit fit(const SlipSamples& samples) = 0;

  /// Whether a window has been accepted yet.
  virtual bool isReady() const = 0;

  /// Predictions for times from the last sample on, on the clock of the samples. Throws std::logic_error if not
  /// ready, std::invalid_argument for a time too early for the model.
  virtual SlipPrediction predict(const Eigen::VectorXd& times_s) const = 0;

  /// Joint covariance (n × n) of the latent slip at such times: how much of its error persists. Throws like predict().
  virtual Eigen::MatrixXd predictCovariance(const Eigen::VectorXd& times_s) const = 0;
};

}  // namespace slipnav
