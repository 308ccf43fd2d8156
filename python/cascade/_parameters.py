"""The parameters of a pattern."""


class Parameters:
    """The parameters of a pattern, by 'stage.name' or, for the current stage, by the name alone.

    pattern.parameters["ka"] and pattern.parameters.ka are Parameter objects with value, low, high,
    step and doc. Assigning a number or an expression sets the parameter: pattern.parameters.ka = 1/80.
    """

    def __init__(self, pattern):
        object.__setattr__(self, "_pattern", pattern)

    def __iter__(self):
        return (f"{p.stage}.{p.name}" for p in self._pattern._parameters())

    def __len__(self):
        return len(self._pattern._parameters())

    def __getitem__(self, name):
        stage, dot, short = name.partition(".")
        if not dot:
            stage, short = self._pattern.stage, name
        for parameter in self._pattern._parameters():
            if parameter.stage == stage and parameter.name == short:
                return parameter
        raise KeyError(name)

    def __setitem__(self, name, value):
        self._pattern.set(name, value)

    def __getattr__(self, name):
        try:
            return self[name]
        except KeyError:
            raise AttributeError(f"stage '{self._pattern.stage}' has no parameter '{name}'") from None

    def __setattr__(self, name, value):
        self[name] = value

    def __dir__(self):
        stage = self._pattern.stage
        return [p.name for p in self._pattern._parameters() if p.stage == stage]

    def __repr__(self):
        return "\n".join(
            f"{p.stage}.{p.name} = {p.value:.9g}" + (f"  in {p.low:g} .. {p.high:g}" if p.low is not None else "")
            + (f"  {p.doc}" if p.doc else "")
            for p in self._pattern._parameters())
