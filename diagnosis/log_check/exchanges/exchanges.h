#pragma once
/// Columns that stand in each other's place: two that are exchanged, or more in a circle.

#include <string>
#include <vector>

#include "diagnosis/calibration/torque_comparison.h"
#include "diagnosis/log_check/log_under_check.h"

namespace halyard {

/// The columns of one joint: its motor's position, its own, and its motor's torque. Called before units are looked for,
/// because a motor in the place of its joint looks like a joint in a wrong unit.
void check_exchanges_at_joints(LogUnderCheck& c);

/// The motors' positions of several joints, or their own. Of all ways to give the joints that disagree with their
/// motors each other's columns, the one after which they agree best.
void check_position_exchanges(LogUnderCheck& c);

/// The motors' positions of several joints without sensors. If some of them are beyond their ranges: the exchange after
/// which all are within, and the torques go with the motions.
void check_motor_exchanges(LogUnderCheck& c);

/// The torques of several motors, or, in a log without joint sensors, their positions. t: of the log as it is. True if
/// columns were exchanged.
bool check_torque_exchanges(LogUnderCheck& c, const TorqueComparison& t);

/// The circles of a permutation of the columns of some joints: joints[i] takes the column of joints[p[i]]. Each begins
/// with its first joint; a joint that keeps its column is in none.
std::vector<ColumnCircle> circles_of(Signals Log::*signal, const std::vector<int>& joints, const std::vector<int>& p);

/// The log after such exchanges, with the zeros that are unknown found anew.
LogUnderCheck after_exchange(LogUnderCheck c, const std::vector<ColumnCircle>& circles);

/// Tells that the columns of a circle are exchanged, and exchanges them. seen: what shows it. or_else: follows the
/// remedy, such as ", or ...".
void reject_exchange(LogUnderCheck& c, const ColumnCircle& circle, const std::string& seen,
                     const std::string& or_else = "");

}  // namespace halyard
