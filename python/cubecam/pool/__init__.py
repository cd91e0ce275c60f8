"""Batches that several processes draw: `Pool`.

`pool.py` has the class; `work.py` what is drawn in one piece, by whichever process; `worker.py` the process that draws;
`crew.py` the processes and who draws what; `remote.py` the same by a user's executor; `memory.py` memory that
processes share; `payload.py` how scenes and functions travel.
"""
