// What can be left out of a model without changing a bit of its run, by what its run did, not by trying.
//
// The stages after the method move points only where they count something: pairs pushed apart, points put out of a
// collider, springs shortened (sim/step.h). Where one counts nothing in any step, no step would have ended in another
// state without it, as each began in the same one; so the whole run has the same bits. That holds for several such
// stages at once as well.
#pragma once

#include <optional>
#include <string>

#include "experiments/needs/alternatives.h"
#include "sim/step.h"

namespace clothlab::experiments::needs {

/// What the stages of all steps of a run did, summed.
struct Deeds {
    std::uint64_t steps = 0;
    std::uint64_t self_contacts = 0, sphere_contacts = 0, plane_contacts = 0, shortened_springs = 0;

    void add(const sim::StepCounts& counts);
};

/// Why leaving this out of the model whose run did these deeds changes no bit of it, as a sentence; nothing where that
/// does not follow from them. Contacts are counted by kind: a sphere that was never touched is not told from one that
/// was.
std::optional<std::string> proof(const Alternative& alternative, const sim::Description& model, const Deeds& deeds);

} // namespace clothlab::experiments::needs
