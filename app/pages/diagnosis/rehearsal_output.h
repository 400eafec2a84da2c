#pragma once
/// What a rehearsal of a diagnosis shows: lines for the terminal and the report, and a member of diagnosis.json.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "app/report/page.h"
#include "diagnosis/rehearse.h"

namespace halyard {

/// One line for each kind of truth that was rehearsed, and one about rehearsals that failed.
std::vector<std::string> rehearsal_lines(const Rehearsals& rehearsals);

/// The member "rehearsals" of diagnosis.json.
nlohmann::ordered_json rehearsals_json(const Diagnosis& diagnosis, const Rehearsals& rehearsals);

/// The lines, the probabilities of the diagnosis' names, and a table of the rehearsals.
void add_rehearsals(report::Page& page, const Diagnosis& diagnosis, const Rehearsals& rehearsals);

}  // namespace halyard
