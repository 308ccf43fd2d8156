// Finds the registers that hold states.
#include "tissue/tissue_rules.h"

#include <algorithm>

namespace cascade {

std::vector<RegisterId> state_registers(const Scheme& scheme) {
    std::vector<RegisterId> registers{old_register};
    for (const Sweep& sweep : scheme.sweeps) {
        const RegisterId at = sweep.inputs[0];
        if (!scheme.forms[sweep.form].uses_rates()) continue;
        if (std::find(registers.begin(), registers.end(), at) == registers.end()) {
            registers.push_back(at);
        }
    }
    return registers;
}

}  // namespace cascade
