"""python -m armcal_program, where the PATH does not have armcal."""

from armcal_program import main

main()
