"""What Redis does in one step: scripts in Lua, whose keys and arguments are told below each."""

from __future__ import annotations

ADD_JOBS = """
if redis.call('HEXISTS', KEYS[1], 'resource') == 0 then
  return 0
end
for i = 1, (#KEYS - 6) / 2 do
  local job, events = KEYS[2 * i + 5], KEYS[2 * i + 6]
  local id, task, message = ARGV[3 * i + 6], ARGV[3 * i + 7], ARGV[3 * i + 8]
  redis.call('HSET', job, 'task', task, 'created', ARGV[1])
  redis.call('EXPIRE', job, ARGV[4])
  redis.call('XADD', events, '*', 'kind', 'queued', 'event', ARGV[6])
  redis.call('EXPIRE', events, ARGV[4])
  redis.call('ZADD', KEYS[2], ARGV[2], id)
  redis.call('ZADD', KEYS[3], ARGV[3], id)
  redis.call('ZADD', KEYS[5], ARGV[2], id)
  redis.call('LPUSH', KEYS[4], message)
end
local answers, bytes = KEYS[5], KEYS[6]
local function forget(id)
  redis.call('HINCRBY', bytes, 'sum', -(redis.call('HGET', bytes, id) or 0))
  redis.call('HDEL', bytes, id)
  redis.call('ZREM', answers, id)
end
for _, id in ipairs(redis.call('ZRANGEBYSCORE', answers, 0, ARGV[5])) do
  forget(id)
end
local more = redis.call('ZCARD', answers) - ARGV[7]
for i, id in ipairs(redis.call('ZRANGE', answers, 0, math.max(more, 1000) - 1)) do
  if i > more and tonumber(redis.call('HGET', bytes, 'sum') or 0) <= tonumber(ARGV[8]) then
    break
  end
  local job = 'querycad:job:' .. id
  if redis.call('HEXISTS', job, 'record') == 1 or redis.call('EXISTS', job) == 0 then
    local task = redis.call('HGET', job, 'task')
    if task then
      task = cjson.decode(task)
      redis.call('ZREM', 'querycad:asked:' .. task.tenant .. ':' .. task.model, id)
    end
    redis.call('DEL', job, 'querycad:events:' .. id, 'querycad:done:' .. id)
    forget(id)
  end
end
redis.call('EXPIRE', answers, ARGV[4])
redis.call('EXPIRE', bytes, ARGV[4])
redis.call('ZREMRANGEBYSCORE', KEYS[2], 0, ARGV[5])
redis.call('EXPIRE', KEYS[2], ARGV[4])
return 1
"""
"""Keys: model, what was asked about it, pending, queue, the tenant's jobs, bytes of its answers, then of each job:
itself, its events. Arguments: time as text and as a number, when jobs are looked at again, seconds kept, before when
jobs are forgotten, event, how many answers of the tenant are kept, how many bytes of them, then of each job: id, task,
message for the queue. 0, and nothing is done, when there is no such model. What is too much goes, the oldest first, a
thousand at a time where it is bytes; what is not answered yet stays."""
FORGET_BYTES = """
for _, id in ipairs(ARGV) do
  redis.call('HINCRBY', KEYS[1], 'sum', -(redis.call('HGET', KEYS[1], id) or 0))
  redis.call('HDEL', KEYS[1], id)
end
if redis.call('HLEN', KEYS[1]) == 1 then
  redis.call('DEL', KEYS[1])
end
"""
"""Key: bytes of a tenant's answers. Arguments: ids of jobs that are dropped."""
ADD_MODEL = """
if redis.call('HEXISTS', KEYS[1], 'resource') == 1 then
  return 0
end
local stored = tonumber(ARGV[4])
for _, size in ipairs(redis.call('HVALS', KEYS[4])) do
  stored = stored + tonumber(size)
end
if stored > tonumber(ARGV[6]) then
  return -1
end
redis.call('HSET', KEYS[1], 'resource', ARGV[1])
redis.call('ZADD', KEYS[2], 'NX', ARGV[3], ARGV[2])
redis.call('SADD', KEYS[3], ARGV[5])
redis.call('HSET', KEYS[4], ARGV[2], ARGV[4])
return 1
"""
"""Keys: model, the tenant's models, the content's owners, sizes of the tenant's models. Arguments: resource, id, time,
bytes, tenant, bytes that the tenant may have. 0: it is there already; -1, and nothing is done: it is too much."""
FINISH_JOB = """
if redis.call('HEXISTS', KEYS[1], 'task') == 0 or redis.call('HSETNX', KEYS[1], 'record', ARGV[1]) == 0 then
  return 0
end
redis.call('HSET', KEYS[1], 'finished', ARGV[2])
redis.call('EXPIRE', KEYS[1], ARGV[3])
redis.call('XADD', KEYS[2], '*', 'kind', 'done', 'event', ARGV[4])
redis.call('EXPIRE', KEYS[2], ARGV[3])
redis.call('XADD', KEYS[6], '*', 'kind', 'done')
redis.call('EXPIRE', KEYS[6], ARGV[6])
redis.call('ZREM', KEYS[3], ARGV[5])
redis.call('ZREM', KEYS[5], ARGV[5])
redis.call('HSET', KEYS[7], ARGV[5], #ARGV[1])
redis.call('HINCRBY', KEYS[7], 'sum', #ARGV[1])
redis.call('EXPIRE', KEYS[7], ARGV[3])
for i = 7, #ARGV, 2 do
  redis.call('HINCRBYFLOAT', KEYS[4], ARGV[i], ARGV[i + 1])
end
return 1
"""
"""Keys and arguments: `keyspace.finished`. A job that is done, or was deleted, stays as it is."""
BEGIN_JOB = """
if redis.call('HEXISTS', KEYS[1], 'task') == 0 or redis.call('HEXISTS', KEYS[1], 'record') == 1 then
  return 0
end
redis.call('HSET', KEYS[1], 'started', ARGV[1], 'touched', ARGV[3])
if redis.call('HEXISTS', KEYS[1], 'waits') == 0 then
  redis.call('XADD', KEYS[2], '*', 'kind', 'started', 'event', ARGV[2])
end
local attempt = redis.call('HINCRBY', KEYS[1], 'attempts', 1)
local model = redis.call('HMGET', KEYS[3], 'resource', 'outcome')
return {attempt, redis.call('HGET', KEYS[1], 'created'), model[1], model[2]}
"""
"""Keys: job, its events, its model. 0 for a job that is done, or was deleted; else the attempt's number, the time at
which it was asked, and what is known of the model, all in one: each way to the store costs more than what is read."""
WAIT_JOB = """
if redis.call('HEXISTS', KEYS[1], 'task') == 1 then
  redis.call('HINCRBY', KEYS[1], 'attempts', -1)
  redis.call('HDEL', KEYS[1], 'started')
  redis.call('HSET', KEYS[1], 'touched', ARGV[2])
  if redis.call('HGET', KEYS[1], 'waits') ~= ARGV[3] then
    redis.call('HSET', KEYS[1], 'waits', ARGV[3])
    redis.call('XADD', KEYS[2], '*', 'kind', 'waiting', 'event', ARGV[1])
  end
end
return 0
"""
"""Keys: job, its events. Arguments: event, time, what is waited for: told once, however often it is looked for."""
FINISH_MODEL = """
local resource = redis.call('HGET', KEYS[1], 'resource')
if not resource or not string.find(resource, ARGV[3], 1, true) then
  return 0
end
if redis.call('HSETNX', KEYS[1], 'outcome', ARGV[1]) == 0 then
  return 0
end
redis.call('XADD', KEYS[2], '*', 'kind', 'done')
redis.call('ZREM', KEYS[3], ARGV[2])
redis.call('HSET', KEYS[4], ARGV[4], cjson.decode(resource).size_bytes + ARGV[5])
return 1
"""
"""Keys: model, its events, models that are read, sizes of the tenant's models. Arguments: outcome, member of the third,
time of the upload, id, bytes of what was read. What came
of a file that was deleted while it was read is none of the same file's that was uploaded anew."""
RESERVE = """
redis.call('ZREMRANGEBYSCORE', KEYS[1], 0, ARGV[2])
local more = 0
for i = 4, #ARGV do
  if not redis.call('ZSCORE', KEYS[1], ARGV[i]) then
    more = more + 1
  end
end
if redis.call('ZCARD', KEYS[1]) + more > tonumber(ARGV[3]) then
  return 0
end
for i = 4, #ARGV do
  redis.call('ZADD', KEYS[1], ARGV[1], ARGV[i])
end
return 1
"""
"""Keys: open jobs of an API key. Arguments: time, before when they are forgotten, how many there may be, jobs. 0, and
none is counted, when that is too many: two requests for the same jobs do not take them from each other."""
