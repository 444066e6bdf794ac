"""
Five parameters of the single diode equation by lyrefit.

Exact sets are fitted curve by curve by least squares. The noisy sets, of which one set of parameters is asked for, are
fitted curve by curve with errors of the readings found from the residuals (``noise='field'``): independent errors of
current and voltage, and a path of the light that wanders. Handed in is the mean of the fits, of ``1 / resistance_shunt``
for the shunt, whose reciprocal is what enters the equation. A set is taken as noisy if its name begins with ``case3``
or the file holds no more digits than a 64-bit number.

"""

import json
import pathlib

import lyrefit

COLUMNS = ('photocurrent', 'saturation_current', 'resistance_series', 'resistance_shunt', 'n')


def get_test_set_filepaths():
    """
    Returns the JSON test sets, wherever this version of the repository keeps them.

    Returns
    -------
        A sorted list of pathlib.Path objects.
    """
    root = pathlib.Path.cwd() / '..' / '..'
    folder = next(f for f in (root / 'ivcurves' / 'test_sets', root / 'test_sets') if f.is_dir())
    return sorted(folder.glob('*.json'))


def fit_curve(curve, cells_in_series, noisy):
    """
    Fits one IV curve of a test set.

    Parameters
    ----------
    curve : dict
        An entry of ``IV Curves``.

    cells_in_series : int
        Number of cells in series.

    noisy : bool
        Whether the readings have errors.

    Returns
    -------
        A dict of the five parameters.
    """
    options = {'noise': 'field'} if noisy else {}
    fit = lyrefit.fit([float(v) for v in curve['Voltages']], [float(i) for i in curve['Currents']],
                      cells_in_series=cells_in_series, temperature_C=float(curve['Temperature']) - 273.15,
                      bound={'n1': (0.5, 3)}, intervals='none', random_baseline=False, **options)
    return {name: fit['parameters'][name]['refined'] for name in COLUMNS}


def mean_of(fits):
    """
    Mean of the parameters of several fits of one device; of the shunt's conductance instead of its resistance.
    """
    mean = {name: sum(f[name] for f in fits) / len(fits) for name in COLUMNS}
    mean['resistance_shunt'] = len(fits) / sum(1 / f['resistance_shunt'] for f in fits)
    return mean


def write_csv(path, rows, cells_in_series):
    """
    Writes rows of (Index, parameters) with all digits of a 64-bit number.
    """
    with open(path, 'w', newline='') as file:
        file.write('Index,' + ','.join(COLUMNS) + ',cells_in_series\n')
        for index, parameters in rows:
            digits = ','.join(repr(parameters[name]) for name in COLUMNS)
            file.write(f'{index},{digits},{cells_in_series}\n')


def is_noisy(name, curves):
    """
    Exact curves are stored with more digits than a 64-bit number has.
    """
    return name.startswith('case3') or max(len(i.lstrip('-0.')) for i in curves[0]['Currents']) <= 18


def main():
    for path in get_test_set_filepaths():
        with open(path) as file:
            test_set = json.load(file)
        curves, cells_in_series = test_set['IV Curves'], test_set['cells_in_series']
        noisy = is_noisy(path.stem, curves)
        fits = [(curve['Index'], fit_curve(curve, cells_in_series, noisy)) for curve in curves]
        rows = [(1, mean_of([fit for _, fit in fits]))] if noisy else fits
        write_csv(pathlib.Path.cwd() / f'{path.stem}.csv', rows, cells_in_series)


if __name__ == '__main__':
    main()
