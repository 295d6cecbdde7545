"""Checks that several sets of the scoreboard share: functions of the runs, whose
docstring is what a right answer says."""

from reading import alike, claim, claims, friction_of, told


def names_only(run, allowed=(), says="nothing is named"):
    """Of a diagnosis: no effect but these has more than 50 %, nor is one of several named
    together none of which is among these."""
    def check(runs):
        other = [e for e in claims(runs[run]) if e["effect"] not in allowed]
        other += [names for names, _ in alike(runs[run]) if not set(names) & set(allowed)]
        return not other, told(runs[run])
    check.__doc__ = f"{run}: {says}"
    return check


def names_none(run, effects, says):
    """Of a diagnosis: none of these effects has more than 50 %."""
    def check(runs):
        return claim(runs[run], effects) is None, told(runs[run])
    check.__doc__ = f"{run}: {says}"
    return check


def leaves(run, most_mm):
    """Of a calibration on poses: the cross-validated rms, mm."""
    def check(runs):
        rms = 1e3 * runs[run]["poses"]["cross_validated_rms"]
        return rms <= most_mm, f"{rms:.3f} mm"
    check.__doc__ = f"{run}: at most {most_mm:g} mm are left, cross-validated"
    return check


def no_success(run, says):
    def check(runs):
        code = runs.code(run)
        return code == 1, f"exit code {code}, {runs[run]['verdict']}"[:110]
    check.__doc__ = f"{run}: {says}"
    return check


def weak_is_differential(weak, differential):
    """Of two calibrations of one log, whose models ask for the same numbers."""
    def check(runs):
        a, b = friction_of(runs[weak]), friction_of(runs[differential])
        apart = {name: abs(a[name][0] - b[name][0]) / a[name][1]
                 for name in sorted(a.keys() & b.keys())}
        worst = max(apart, key=apart.get)
        return (apart[worst] <= 2,
                f"{worst} {a[worst][0]:.3f} +- {a[worst][1]:.3f} and "
                f"{b[worst][0]:.3f}, {apart[worst]:.1f} deviations apart")
    check.__doc__ = (f"{weak}: Coulomb and viscous friction by the weak model are within "
                     "two deviations of the differential model's")
    return check
