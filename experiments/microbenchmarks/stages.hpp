#pragma once

#include "swept_model.hpp"

/// Registers one benchmark a stage: all layers of the model, one after the other, on one thread. `model` must outlive
/// them.
void register_stages(const SweptModel& model);

/// Registers one benchmark a stage of the predicates: one decision.
void register_predicates();
