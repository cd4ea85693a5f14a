"""Run time against error: converged references, errors, estimators, convergence orders, tables and plots."""
