"""Functions under the names, arguments and answers of pvlib-python's, computed by lyrefit.

Experimental: may change in a minor version.

>>> from lyrefit.pvlib import singlediode, fit_desoto_sandia

in the place of ``pvlib.pvsystem.singlediode`` and ``pvlib.ivtools.sdm.fit_desoto_sandia``; pvlib need
not be installed. What they take for one number they take for NumPy arrays and pandas Series, which
are broadcast together.

The single-diode equation is solved on the junction's voltage to the last digits, whatever ``method``
says; the argument is there so that calls need not change. Where an argument lies outside its range
(saturation_current > 0, resistance_series >= 0, resistance_shunt > 0 or infinite, nNsVth > 0) or is
NaN, the answer is NaN.
"""

import sys
from collections import OrderedDict

import numpy as np

from . import _lyrefit

__all__ = ["fit_desoto_sandia", "fit_pvsyst_iec61853_sandia_2025", "fit_sandia_simple", "i_from_v", "max_power_point", "singlediode",
           "v_from_i"]

_METHODS = ("lambertw", "newton", "brentq", "chandrupatla")
_POINTS = ("i_sc", "v_oc", "i_mp", "v_mp", "p_mp", "i_x", "i_xx")


def _check_method(method):
    if method.lower() not in _METHODS:
        raise NotImplementedError(f"method: expected one of {', '.join(_METHODS)}, found '{method}'")


def _flat(*values):
    """The common shape of the values, and each as one row of doubles."""
    arrays = np.broadcast_arrays(*(np.asarray(value, dtype=np.float64) for value in values))
    return arrays[0].shape, [array.reshape(-1) for array in arrays]


def _index(values):
    """The index of the first pandas Series; None where there is none, or no pandas."""
    pandas = sys.modules.get("pandas")
    if pandas is None:
        return None
    return next((value.index for value in values if isinstance(value, pandas.Series)), None)


def _answer(numbers, shape, given):
    if all(map(np.isscalar, given)):
        return float(numbers[0])
    return numbers.reshape(shape)


def i_from_v(voltage, photocurrent, saturation_current, resistance_series, resistance_shunt, nNsVth,
             method="lambertw"):
    """Current at a voltage, in ampere.

    Parameters
    ----------
    voltage : numeric
        Terminal voltage, also below zero and beyond open circuit. [V]
    photocurrent, saturation_current : numeric
        [A]
    resistance_series, resistance_shunt : numeric
        [ohm]
    nNsVth : numeric
        Ideality times cells in series times thermal voltage. [V]
    method : str
        'lambertw', 'newton', 'brentq' or 'chandrupatla': all give the same.

    Returns
    -------
    float where all arguments are numbers, else array of the broadcast shape.
    """
    _check_method(method)
    given = (voltage, photocurrent, saturation_current, resistance_series, resistance_shunt, nNsVth)
    shape, rows = _flat(*given)
    return _answer(_lyrefit._current_at(rows[0], rows[1:]), shape, given)


def v_from_i(current, photocurrent, saturation_current, resistance_series, resistance_shunt, nNsVth,
             method="lambertw"):
    """Voltage at a current, in volt; arguments and answer as those of :func:`i_from_v`.

    NaN where no voltage gives that current: beyond photocurrent and saturation current where
    ``resistance_shunt`` is infinite.
    """
    _check_method(method)
    given = (current, photocurrent, saturation_current, resistance_series, resistance_shunt, nNsVth)
    shape, rows = _flat(*given)
    return _answer(_lyrefit._voltage_at(rows[0], rows[1:]), shape, given)


def singlediode(photocurrent, saturation_current, resistance_series, resistance_shunt, nNsVth,
                ivcurve_pnts=None, method="lambertw"):
    """Short circuit, open circuit, maximum power and two points between, of one or many devices.

    Parameters
    ----------
    photocurrent, saturation_current, resistance_series, resistance_shunt, nNsVth : numeric
        As in :func:`i_from_v`.
    ivcurve_pnts : int, optional
        Points of each curve to give beside them, as pvlib did up to version 0.10. For 'lambertw'
        they are evenly spaced in voltage, else dense towards open circuit. (Newer versions have
        ``method`` in this place: a text here is taken for it.)
    method : str
        As in :func:`i_from_v`.

    Returns
    -------
    dict of floats where all parameters are numbers, else pandas DataFrame with one row a device and
    the index of the first Series; dict of arrays where ``ivcurve_pnts`` is given. Keys: i_sc, v_oc,
    i_mp, v_mp, p_mp, i_x (at v_oc / 2), i_xx (at the mean of v_oc and v_mp), and with
    ``ivcurve_pnts`` also i and v, one row a device.
    """
    if isinstance(ivcurve_pnts, str):
        ivcurve_pnts, method = None, ivcurve_pnts
    _check_method(method)
    given = (photocurrent, saturation_current, resistance_series, resistance_shunt, nNsVth)
    shape, rows = _flat(*given)
    table = _lyrefit._single_diode_points(rows)
    if all(map(np.isscalar, given)):
        answer = dict(zip(_POINTS, table[:, 0].tolist()))
    elif ivcurve_pnts:
        answer = {name: row.reshape(shape) for name, row in zip(_POINTS, table)}
    else:
        import pandas

        return pandas.DataFrame(table.T, columns=_POINTS, index=_index(given))
    if ivcurve_pnts:
        answer["i"], answer["v"] = _curves(rows, table[1], shape, ivcurve_pnts, method.lower())
    return answer


def _curves(rows, v_oc, shape, points, method):
    """Currents and voltages of every device, along the last axis."""
    each = [np.repeat(row, points) for row in rows]
    if method == "lambertw":
        voltage = np.multiply.outer(v_oc, np.linspace(0, 1, points)).reshape(-1)
        current = _lyrefit._current_at(voltage, each)
    else:
        # Voltage and current are explicit functions of the junction voltage.
        spread = (11 - np.logspace(np.log10(11), 0, points)) / 10
        junction = np.multiply.outer(v_oc, spread).reshape(-1)
        photocurrent, saturation_current, resistance_series, resistance_shunt, nNsVth = each
        current = (photocurrent - saturation_current * np.expm1(junction / nNsVth)
                   - junction / resistance_shunt)
        voltage = junction - current * resistance_series
    return current.reshape(*shape, points), voltage.reshape(*shape, points)


def max_power_point(photocurrent, saturation_current, resistance_series, resistance_shunt, nNsVth,
                    d2mutau=0, NsVbi=np.inf, method="brentq"):
    """Maximum power point alone.

    Parameters
    ----------
    photocurrent, saturation_current, resistance_series, resistance_shunt, nNsVth : numeric
        As in :func:`i_from_v`.
    d2mutau, NsVbi : numeric
        PVsyst's recombination loss of thin films, and their built-in voltage. [V]
    method : str
        As in :func:`i_from_v`.

    Returns
    -------
    OrderedDict, or DataFrame where ``photocurrent`` is a Series: i_mp [A], v_mp [V], p_mp [W].
    """
    _check_method(method)
    given = (photocurrent, saturation_current, resistance_series, resistance_shunt, nNsVth, d2mutau,
             NsVbi)
    shape, rows = _flat(*given)
    table = _lyrefit._single_diode_points(rows)
    points = OrderedDict((name, _answer(table[_POINTS.index(name)], shape, given))
                         for name in ("i_mp", "v_mp", "p_mp"))
    index = _index((photocurrent,))
    if index is None:
        return points
    import pandas

    return pandas.DataFrame(points, index=index)


def fit_sandia_simple(voltage, current, v_oc=None, i_sc=None, v_mp_i_mp=None, vlim=0.2, ilim=0.1):
    """The five parameters of one curve, by least squares of the current instead of two regressions.

    Parameters
    ----------
    voltage, current : array
        One curve in any order, also outside of the first quadrant. [V], [A]
    v_oc : float, optional
        Open circuit voltage, which only says how many cells to suppose; else read off the curve. [V]
    i_sc, v_mp_i_mp, vlim, ilim
        Not needed.

    Returns
    -------
    tuple of float
        photocurrent, saturation_current [A], resistance_series, resistance_shunt [ohm], nNsVth [V]

    Raises
    ------
    RuntimeError
        Where the fit is not usable. lyrefit.Error, a ValueError, where the curve is not.

    Notes
    -----
    nNsVth is looked for between 0.4 and 4 thermal voltages of 25 C per supposed cell of 0.65 V.
    ``lyrefit.fit`` takes the true cells and temperature, and gives intervals and warnings.
    """
    voltage, current = np.asarray(voltage, dtype=float), np.asarray(current, dtype=float)
    if v_oc is None:
        v_oc = np.max(voltage, where=current >= 0, initial=0)
    cells = max(1, round(v_oc / 0.65))
    fit = _lyrefit.fit(voltage, current, cells_in_series=cells, temperature_C=_TEMPERATURE_C,
                       irradiance_Wm2=_IRRADIANCE_W_m2, bound={"n1": (0.4, 4)}, intervals="none",
                       find_errors=False)
    if not fit.usable:
        raise RuntimeError("; ".join(fit["warnings"]) or "no usable fit was found")
    found = fit.parameters
    thermal_V = cells * _BOLTZMANN / _CHARGE * (_TEMPERATURE_C + _KELVIN)
    return (found["photocurrent"], found["saturation_current"], found["resistance_series"],
            found["resistance_shunt"], found["n"] * thermal_V)


# Reference conditions of lyrefit's laws, and pvlib's slope of the band gap.
_IRRADIANCE_W_m2 = 1000.0
_TEMPERATURE_C = 25.0
_KELVIN = 273.15
_BANDGAP_SLOPE = -0.0002677
_BOLTZMANN = 1.380649e-23
_CHARGE = 1.602176634e-19


def fit_desoto_sandia(ivcurves, specs, const=None, maxiter=5, eps1=1.0e-3):
    """De Soto's five parameters, the band gap and the curves' own, from curves at several conditions.

    All readings of all curves are fitted at once by least squares of the current (see
    ``lyrefit.fit_family``, which also gives intervals, tests and warnings), where pvlib fits curve by
    curve and then draws lines through what it found. The answer is that of the least sum of squares;
    nothing but the conditions, ``cells_in_series`` and ``alpha_sc`` is taken as given.

    Parameters
    ----------
    ivcurves : dict
        v, i : sequence of arrays, voltage [V] and current [A] of each curve, in any order, also
        outside of the first quadrant. ee : irradiance of each [W/m2]. tc : cell temperature of each
        [C]. The other keys of pvlib (i_sc, v_oc, i_mp, v_mp) are not needed.
    specs : dict
        cells_in_series : int. alpha_sc : temperature coefficient of Isc at E0 [A/K], held as stated.
        beta_voc is not needed.
    const : dict, optional
        E0, T0 : the reference, 1000 W/m2 and 25 C where nothing is said. k, q : constants in which
        EgRef is expressed, CODATA's where nothing is said.
    maxiter, eps1
        Not needed: the fit goes on until it has converged.

    Returns
    -------
    dict
        I_L_ref, I_o_ref [A], R_s, R_sh_ref [ohm], a_ref [V], EgRef [eV], dEgdT [1/K, held],
        cells_in_series, and of each curve iph, io [A], rs, rsh [ohm] as the law gives them at its
        conditions, and u: whether it was fitted. With ``alpha_sc``, all that
        ``pvlib.pvsystem.calcparams_desoto`` needs for the same curves.

    Raises
    ------
    RuntimeError
        Where the fit is not usable. lyrefit.Error, a ValueError, where curves or conditions are not.
    """
    const = {"E0": _IRRADIANCE_W_m2, "T0": _TEMPERATURE_C, "k": _BOLTZMANN, "q": _CHARGE,
             **(const or {})}
    cells = int(specs["cells_in_series"])
    irradiance = np.array(ivcurves["ee"], dtype=np.float64) * (_IRRADIANCE_W_m2 / const["E0"])
    temperature = np.array(ivcurves["tc"], dtype=np.float64)
    away_K = const["T0"] - _TEMPERATURE_C
    # Converted so that the slope relative to the band gap at T0 is pvlib's.
    slope = _BANDGAP_SLOPE / (1 - _BANDGAP_SLOPE * away_K)
    found = _lyrefit._fit_desoto(
        [np.asarray(v, dtype=np.float64) for v in ivcurves["v"]],
        [np.asarray(i, dtype=np.float64) for i in ivcurves["i"]], irradiance, temperature, cells,
        {"alpha_sc": float(specs["alpha_sc"]), "dEgdT": slope})
    if not found["usable"]:
        raise RuntimeError("; ".join(found["warnings"]) or "no usable fit was found")
    answer = _at_reference(found["shared"], const["T0"])
    answer["EgRef"] *= (const["k"] / const["q"]) / (_BOLTZMANN / _CHARGE)
    iph, io, _, rs, rsh = found["devices"].T.copy()
    used = found["belongs"]
    index = _index((ivcurves.get("i_sc"),))
    if index is not None:
        import pandas

        iph, used = pandas.Series(iph, index=index), pandas.Series(used, index=index)
    return {"dEgdT": _BANDGAP_SLOPE, **answer, "iph": iph, "io": io, "rsh": rsh, "rs": rs, "u": used,
            "cells_in_series": cells}


def fit_pvsyst_iec61853_sandia_2025(effective_irradiance, temp_cell, i_sc, v_oc, i_mp, v_mp,
                                    cells_in_series, EgRef=1.121, alpha_sc=None, beta_mp=None,
                                    R_s=None, r_sh_coeff=0.12, min_Rsh_irradiance=None,
                                    irradiance_tolerance=20, temperature_tolerance=1):
    """PVsyst's parameters from a matrix of key points, such as that of IEC 61853-1.

    All conditions are fitted at once: least squares of Isc, Voc, Vmp (where dP/dV = 0) and Pmp, each
    in parts of its error, where pvlib draws one line after the other through what it found before.
    Any conditions serve, with gaps (NaN) or without; none of them need be the reference. See
    ``lyrefit.fit_family`` and the page of ``lyrefit fit`` for intervals, held-out conditions and
    errors of Pmp.

    Parameters
    ----------
    effective_irradiance, temp_cell, i_sc, v_oc, i_mp, v_mp : array
        One value a condition. [W/m2], [C], [A], [V], [A], [V]
    cells_in_series : int
    EgRef : float
        Band gap at 25 C, held. [eV]
    alpha_sc, R_s : float, optional
        Held as stated instead of fitted. [A/K], [ohm]
    beta_mp, r_sh_coeff, min_Rsh_irradiance, irradiance_tolerance, temperature_tolerance
        Not needed.

    Returns
    -------
    dict
        alpha_sc [A/K], gamma_ref, mu_gamma [1/K], I_L_ref, I_o_ref [A], R_sh_ref, R_sh_0 [ohm],
        R_sh_exp (5.5, held), R_s [ohm], cells_in_series, EgRef [eV]: the keywords of
        ``pvlib.pvsystem.calcparams_pvsyst``.

    Raises
    ------
    RuntimeError
        Where the fit is not usable. lyrefit.Error, a ValueError, where the conditions are not.
    """
    held = {"EgRef": EgRef, "alpha_sc": alpha_sc, "R_s": R_s}
    _, columns = _flat(effective_irradiance, temp_cell, i_sc, v_oc, i_mp, v_mp)
    found = _lyrefit._fit_matrix(columns, int(cells_in_series),
                                 {name: float(value) for name, value in held.items()
                                  if value is not None})
    if not found["usable"]:
        raise RuntimeError("; ".join(found["warnings"]) or "no usable fit was found")
    names = ("alpha_sc", "gamma_ref", "mu_gamma", "I_L_ref", "I_o_ref", "R_sh_ref", "R_sh_0",
             "R_sh_exp", "R_s", "cells_in_series", "EgRef")
    return {**{name: found["shared"][name] for name in names},
            "cells_in_series": int(cells_in_series)}


def _at_reference(shared, temperature_C):
    """De Soto's parameters counted from another temperature than 25 C."""
    ratio = (temperature_C + _KELVIN) / (_TEMPERATURE_C + _KELVIN)
    away_K = temperature_C - _TEMPERATURE_C
    gap_eV = shared["EgRef"] * (1 + shared["dEgdT"] * away_K)
    k_eV = _BOLTZMANN / _CHARGE * (_TEMPERATURE_C + _KELVIN)
    barrier = (shared["EgRef"] - gap_eV / ratio) / k_eV
    return {"I_L_ref": shared["I_L_ref"] + shared["alpha_sc"] * away_K,
            "I_o_ref": shared["I_o_ref"] * ratio**3 * float(np.exp(barrier)),
            "EgRef": gap_eV, "R_sh_ref": shared["R_sh_ref"], "R_s": shared["R_s"],
            "a_ref": shared["a_ref"] * ratio}
